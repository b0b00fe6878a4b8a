"""Tolerances of kinematic analyses: derivatives and clearances against closed forms, members, yields, indices, what is refused."""

import json
import math

import h5py
import numpy as np
import pytest
from support import ROOT, call, scratch, written

FOUR_BAR = (ROOT / "inputs/tolerance_four_bar.deck").read_text()
SLIDER_CRANK = (ROOT / "inputs/tolerance_slider_crank.deck").read_text()


def study(program, text, *options, **values):
    """summary.json of a study, and its directory."""
    directory = scratch()
    settings = [word for name, value in values.items() for word in ("--set", f"{name}={value}")]
    call(program, "tolerance", written(directory, text), "--out", directory / "out", "--quiet", *settings, *options)
    return json.loads((directory / "out/summary.json").read_text()), directory / "out"


def rocker_of(a, b, c, d, theta, branch=1):
    """Angles of rocker and coupler by the triangle of coupler, rocker and the line between their outer pins."""
    x, y = a * math.cos(theta), a * math.sin(theta)
    e = math.hypot(d - x, y)
    along = (b * b - c * c + e * e) / (2 * e)
    across = branch * math.sqrt(b * b - along * along)
    head = x + ((d - x) * along + y * across) / e, y + (-y * along + (d - x) * across) / e
    return math.atan2(head[1], head[0] - d), math.atan2(head[1] - y, head[0] - x)


def slopes_of(a, b, c, d, theta, branch=1):
    """Derivatives of the angle of the rocker."""
    rocker, coupler = rocker_of(a, b, c, d, theta, branch)
    size = c * math.sin(rocker - coupler)
    return {"a": -math.cos(theta - coupler) / size, "b": -1 / size, "c": math.cos(rocker - coupler) / size,
            "d": math.cos(coupler) / size, "theta": a * math.sin(theta - coupler) / size}


@pytest.mark.parametrize("degrees, branch", [(30, 1), (90, 1), (30, -1), (143, 1), (-71, -1), (300, 1)])
def test_derivatives_of_a_four_bar(gudgeon, degrees, branch):
    """All derivatives, worst case and root sum square against closed forms, to 1e-10."""
    summary, _ = study(gudgeon, FOUR_BAR, theta=f"{degrees}deg", branch=branch)
    rocker = summary["tolerance"]["request.rocker"]
    exact = slopes_of(0.02, 0.06, 0.05, 0.07, math.radians(degrees), branch)
    for name, slope in exact.items():
        assert rocker["derivative"][name]["value"] == pytest.approx([slope] * 2, rel=1e-10)
    parameters = summary["tolerance_study"]["parameters"]
    worst = sum(abs(slope) * 0.5 * (parameters[name]["upper"] - parameters[name]["lower"]) for name, slope in exact.items())
    assert rocker["band"]["value"] == pytest.approx([worst] * 2, rel=1e-10)
    sigma = math.sqrt(sum((slope * parameters[name]["sigma"]) ** 2 for name, slope in exact.items()))
    assert rocker["sigma"]["value"] == pytest.approx([sigma] * 2, rel=1e-10)
    assert rocker["band"]["time"] == [0.0, 1.0]


def test_published_derivatives(gudgeon):
    """Numbers computed with 30 digits for 30 degrees."""
    summary, _ = study(gudgeon, FOUR_BAR)
    by = summary["tolerance"]["request.rocker"]["derivative"]
    for name, slope in {"a": -23.2735748683, "b": -23.7169869391, "c": 12.7473710808, "d": 17.8731737096}.items():
        assert by[name]["value"][0] == pytest.approx(slope, rel=1e-11)


def test_mean_of_second_order(gudgeon):
    """The mean to second order has half the sum of the second derivatives times the variances."""
    summary, _ = study(gudgeon, FOUR_BAR, plus="0.5mm")
    parameters = summary["tolerance_study"]["parameters"]
    links = {"a": 0.02, "b": 0.06, "c": 0.05, "d": 0.07, "theta": math.radians(30)}
    shift = 0.0
    for name, link in links.items():
        h = 1e-3 * link
        values = [rocker_of(**{**links, name: link + step}, branch=1)[0] for step in (-h, 0, h)]
        shift += 0.5 * (values[0] - 2 * values[1] + values[2]) / h**2 * parameters[name]["sigma"] ** 2
    rocker = summary["tolerance"]["request.rocker"]
    assert rocker["mean"]["value"][0] - rocker["nominal"]["value"][0] == pytest.approx(shift, rel=1e-4)


@pytest.mark.parametrize("degrees", [90, 20, 250])
def test_clearance_of_a_slider_crank(gudgeon, degrees):
    """A pin in its circle: band c/cos(beta), sigma c/(2 cos(beta)) in it and c/(sqrt(2) cos(beta)) on it; by force one end."""
    r, rod, c, theta = 0.05, 0.12, 0.5e-3, math.radians(degrees)
    cosine = math.sqrt(1 - (r * math.sin(theta) / rod) ** 2)
    found = {}
    for pin in ("disc", "circle", "worst", "force"):
        summary, _ = study(gudgeon, SLIDER_CRANK, theta=f"{degrees}deg", pin=pin)
        found[pin] = summary["tolerance"]["slider.position.x"]
    for pin in ("disc", "circle", "worst"):
        assert found[pin]["band"]["value"] == pytest.approx([c / cosine] * 2, rel=1e-10)
    assert found["disc"]["sigma"]["value"][0] == pytest.approx(c / cosine / 2, rel=1e-10)
    assert found["circle"]["sigma"]["value"][0] == pytest.approx(c / cosine / math.sqrt(2), rel=1e-10)
    assert found["worst"]["sigma"]["value"][0] == 0
    assert found["disc"]["derivative"]["l"]["value"][0] == pytest.approx(1 / cosine, rel=1e-10)
    slope = math.cos(theta) - r * math.sin(theta) ** 2 / (rod * cosine)
    assert found["disc"]["derivative"]["r"]["value"][0] == pytest.approx(slope, rel=1e-10)
    # the gas pushes the slider to the crank: its pin rests on the side of the hole that is next to the crank, along the rod
    force = found["force"]
    assert force["band"]["value"][0] == 0
    sine = r * math.sin(theta) / rod
    place = -cosine * c, sine * c  # of the pin from the hole; the end of the rod is there less this place
    exact = place[0] + r * math.cos(theta) + math.sqrt(rod**2 - (place[1] + r * math.sin(theta)) ** 2)
    assert force["mean"]["value"][0] == pytest.approx(exact, abs=2e-8)
    assert exact - force["nominal"]["value"][0] == pytest.approx(-c / cosine, rel=5e-3)
    assert force["clearance"]["gudgeon"]["direction_x"][0] == pytest.approx(-cosine, rel=1e-10)


def test_book_case(gudgeon):
    """Numbers computed with 30 digits at 90 degrees, and what a force of the other sign does."""
    x = study(gudgeon, SLIDER_CRANK)[0]["tolerance"]["slider.position.x"]
    assert x["nominal"]["value"][0] == pytest.approx(0.10908712114636, rel=1e-12)
    assert x["band"]["value"][0] == pytest.approx(0.55001909821701e-3, rel=1e-10)
    assert x["sigma"]["value"][0] == pytest.approx(0.27500954910850e-3, rel=1e-10)
    pulled = study(gudgeon, SLIDER_CRANK.replace("{-100 N}", "{100 N}"), pin="force")[0]["tolerance"]["slider.position.x"]
    pushed = study(gudgeon, SLIDER_CRANK, pin="force")[0]["tolerance"]["slider.position.x"]
    shifts = [of["mean"]["value"][0] - of["nominal"]["value"][0] for of in (pulled, pushed)]
    assert shifts == pytest.approx([0.549780e-3, -0.550261e-3], abs=2e-9)  # exact: the place of the pin is at the ends of the band


def test_derivative_by_a_clearance(gudgeon):
    """Where a force presses the pin the clearance is a parameter like others; its tolerance widens the circle of other pins."""
    text = SLIDER_CRANK.replace("l       {part}       truncated", "l       {part}       truncated\nc       0.1mm        uniform")
    cosine = math.sqrt(1 - (50 / 120) ** 2)
    force = study(gudgeon, text, pin="force")[0]["tolerance"]["slider.position.x"]
    assert force["derivative"]["c"]["value"][0] == pytest.approx(-1 / cosine, rel=1e-10)
    assert force["band"]["value"][0] == pytest.approx(0.1e-3 / cosine, rel=1e-10)
    disc = study(gudgeon, text)[0]["tolerance"]["slider.position.x"]
    assert disc["derivative"]["c"]["value"][0] == pytest.approx(0, abs=1e-12)
    assert disc["band"]["value"][0] == pytest.approx(0.6e-3 / cosine, rel=1e-10)
    assert disc["sigma"]["value"][0] == pytest.approx(math.sqrt((0.5e-3**2 + 0.1e-3**2 / 3) / 4) / cosine, rel=1e-10)


MOVING = SLIDER_CRANK.replace("{theta}\n\n[force", "{theta + 40 rad/s*t}\n\n[force").replace(
    "requests = slider.position.x", "requests = slider.velocity.x slider.acceleration.x motor.moment").replace(
    "end    = 1 s", "end    = 0.03 s").replace("every  = 1 s", "every  = 0.01 s")


def test_velocities_and_forces(gudgeon):
    """Derivatives of velocities, accelerations and driving moments are those of runs with changed parameters."""
    of, _ = study(gudgeon, MOVING)
    step, runs = 0.02, {}
    for part in (-2, -1, 1, 2):
        runs[part], _ = study(gudgeon, MOVING, l=f"{120 + part * step}mm")
    for name, channel in of["tolerance"].items():
        values = {part: np.array(run["tolerance"][name]["nominal"]["value"]) for part, run in runs.items()}
        slope = (8 * (values[1] - values[-1]) - (values[2] - values[-2])) / (12 * step * 1e-3)
        assert channel["derivative"]["l"]["value"] == pytest.approx(slope, rel=1e-7, abs=1e-7 * np.abs(slope).max()), name


def test_members(gudgeon):
    """Members by the expansion and assembled members agree within its stated error; the same seed gives the same bits."""
    text = FOUR_BAR + "\n[tolerance.study]\nmembers = 400\npoints = 100\n"
    first, _ = study(gudgeon, text)
    again, _ = study(gudgeon, text)
    assert first["tolerance"] == again["tolerance"]
    exact, _ = study(gudgeon, text + "method = exact\n")
    assert (first["tolerance_study"]["method"], exact["tolerance_study"]["method"]) == ("expansion", "exact")
    one, other = (of["tolerance"]["request.rocker"] for of in (first, exact))
    for name in ("mean", "sigma"):
        assert one[name]["sampled"] == pytest.approx(other[name]["sampled"], abs=2 * one["expansion_error"])
    assert one["histogram"]["counts"] == other["histogram"]["counts"]
    assert sum(one["histogram"]["counts"]) == 400
    assert one["expansion_error"] < 1e-4 * one["sigma"]["value"][0]
    seeded, _ = study(gudgeon, text + "seed = 2\n")
    assert seeded["tolerance"]["request.rocker"]["mean"]["sampled"] != one["mean"]["sampled"]


def test_intervals_and_yield(gudgeon):
    """Means, deviations, indices are those to first order within their intervals; the yield is that of a normal."""
    text = FOUR_BAR.replace("truncated", "normal").replace("98.3deg    98.9deg", "98.55deg   -")
    rocker = study(gudgeon, text)[0]["tolerance"]["request.rocker"]
    for name in ("mean", "sigma"):
        half = rocker[name]["sampled_high"][0] - rocker[name]["sampled_low"][0]
        assert abs(rocker[name]["sampled"][0] - rocker[name]["value"][0]) < half
    for index in rocker["index"].values():
        assert abs(index["value"][0] - index["linear"][0]) < index["high"][0] - index["low"][0]
        assert abs(index["total"][0] - index["linear"][0]) < index["total_high"][0] - index["total_low"][0]
    assert sum(index["linear"][0] for index in rocker["index"].values()) == pytest.approx(1)
    far = (rocker["mean"]["value"][0] - math.radians(98.55)) / rocker["sigma"]["value"][0]
    assert rocker["yield"]["low"] < 0.5 * math.erfc(-far / math.sqrt(2)) < rocker["yield"]["high"]


@pytest.mark.parametrize("pin", ["disc", "circle", "force", "worst"])
@pytest.mark.parametrize("plan", ["monte_carlo", "latin_hypercube", "sobol"])
def test_worst_members(gudgeon, pin, plan):
    """Lowest and highest members: those of the range, at the place that the pin and the parts give in closed form."""
    text = SLIDER_CRANK.replace("requests = slider", f"members = 256\nmethod = exact\nplan = {plan}\nrequests = slider")
    summary, out = study(gudgeon, text, pin=pin, part="0.05mm", theta="60deg")
    of = summary["tolerance"]["slider.position.x"]
    with h5py.File(out / "tolerance.h5") as file:
        table = file["tolerance_worst"]
        assert table.attrs["parts"] == "r l gudgeon.x gudgeon.y" and (table["member"][()] >= 1).all()
        assert (table["member"][()] <= 256).all() and table["member"][0] != table["member"][1]
        values, deviations, shares = table["value"][()], table["deviation"][()], table["share"][()]
    assert list(values) == [of["range"]["low"][0], of["range"]["high"][0]]
    np.testing.assert_allclose(shares, deviations / [5e-5, 5e-5, 5e-4, 5e-4], rtol=1e-12)
    for value, (dr, dl, x, y) in zip(values, deviations):
        assert {"disc": math.hypot(x, y) < 5.0001e-4, "circle": math.hypot(x, y) == pytest.approx(5e-4, rel=1e-12),
                "force": math.hypot(x, y) == pytest.approx(5e-4, rel=1e-12), "worst": x == y == 0}[pin]
        height = (0.05 + dr) * math.sin(math.pi / 3)
        places = [(0.05 + dr) * 0.5 + math.sqrt((0.12 + dl) ** 2 - (height + side * y) ** 2) + side * x for side in (-1, 1)]
        assert min(abs(value - place) for place in places) < 1e-13


def test_latin_hypercube(gudgeon):
    """The mean of a hypercube is next to the exact one, far closer than its interval."""
    text = FOUR_BAR + "\n[tolerance.study]\nplan = latin_hypercube\nmembers = 2000\npoints = 50\n"
    rocker = study(gudgeon, text)[0]["tolerance"]["request.rocker"]
    half = 0.5 * (rocker["mean"]["sampled_high"][0] - rocker["mean"]["sampled_low"][0])
    assert abs(rocker["mean"]["sampled"][0] - rocker["mean"]["value"][0]) < 0.1 * half


def test_members_that_cannot_be_assembled(gudgeon):
    """A crank next to the dead centre of coupler and rocker: members beyond it are failed parts, counted by assembling them."""
    # a + d = 90 mm, b + c = 90.05 mm at theta = 180 deg: open if a + d exceeds b + c
    text = FOUR_BAR.replace("truncated", "uniform") + "\n[tolerance.study]\nmembers = 300\npoints = 20\nrequests = rocker.angle\n"
    values = {"a": "20mm", "b": "50mm", "c": "40.05mm", "d": "70mm", "theta": "180deg"}
    summary, _ = study(gudgeon, text, **values)
    common, rocker = summary["tolerance_study"], summary["tolerance"]["rocker.angle"]
    assert common["method"] == "exact"
    # P(da + dd - db - dc > 0.05 mm), each uniform within 0.05 mm: Irwin and Hall: 1 - F(2.5) of four, F(2.5) = 0.8021
    assert common["open"] / 300 == pytest.approx(0.198, abs=0.07)
    assert rocker["yield"]["open"] == common["open"] == 300 - common["yield"]["good"] or common["yield"]["good"] < 300
    assert rocker["yield"]["value"] <= 1 - common["open"] / 300


def test_fit(gudgeon):
    """H7/f7 of 20 mm: clearance from 10 to 31 um, of the radius."""
    text = SLIDER_CRANK.replace("name    plus_minus   distribution\nr       {part}       truncated\nl       {part}       truncated",
                                "name   fit     diameter\nc      H7/f7   20mm")
    summary, _ = study(gudgeon, text, c="20um")
    of = summary["tolerance_study"]["parameters"]["c"]
    assert [of["lower"], of["upper"], of["mean"]] == pytest.approx([10e-6, 31e-6, 20.5e-6], rel=1e-9)
    cosine = math.sqrt(1 - (50 / 120) ** 2)
    assert summary["tolerance"]["slider.position.x"]["band"]["value"][0] == pytest.approx(31e-6 / cosine, rel=1e-9)


def test_cheapest_tolerances(gudgeon):
    """Costs per tolerance: the cheapest widths are those of Lagrange, and a study with them has the yield that was asked for."""
    rows = FOUR_BAR[FOUR_BAR.index("[tolerance]"):FOUR_BAR.index("[tolerance.limit]")]
    table = "[tolerance]\nname plus_minus distribution cost\n{}\n\n"
    now = {"a": (0.05, 1), "b": (0.05, 3), "c": (0.05, 2), "d": (0.05, 0)}
    text = FOUR_BAR.replace("98.3deg    98.9deg", "98.5deg    98.7deg") + "\n[tolerance.study]\ntarget = 0.99\nmembers = 20000\n"

    def table_of(widths):
        rows_of = (f"{name} {width!r}mm normal {now[name][1] * now[name][0] / width!r}" for name, width in widths.items())
        return table.format("\n".join(rows_of))

    rocker = study(gudgeon, text.replace(rows, table_of({name: width for name, (width, _) in now.items()})))[0]["tolerance"]["request.rocker"]
    found = rocker["cheapest"]
    slopes, sigma = slopes_of(0.02, 0.06, 0.05, 0.07, math.radians(30)), found["sigma"]
    parts = {name: (slopes[name] * width * 1e-3 / 3) ** 2 for name, (width, _) in now.items()}
    weights = {name: (now[name][1] / parts[name]) ** (1 / 3) for name in "abc"}
    scale = math.sqrt((sigma**2 - parts["d"]) / sum(parts[name] * weights[name] ** 2 for name in "abc"))
    for name in "abc":
        assert found["width"][name] == pytest.approx(5e-5 * scale * weights[name], rel=1e-8)
    assert found["width"]["d"] == 5e-5
    assert found["cost"] == pytest.approx(sum(now[name][1] / (scale * weights[name]) for name in "abc"), rel=1e-8)
    assert found["cost_now"] == 6 and found["target"] == 0.99
    widths = {name: 1e3 * width for name, width in found["width"].items()}
    again, out = study(gudgeon, text.replace(rows, table_of(widths)))
    of = again["tolerance"]["request.rocker"]
    assert of["yield"]["low"] < 0.99 < of["yield"]["high"]
    assert of["sigma"]["value"][0] == pytest.approx(sigma, rel=1e-6)
    assert of["cheapest"]["width"]["a"] == pytest.approx(found["width"]["a"], rel=1e-4)  # the mean to second order moves with the widths
    with h5py.File(out / "tolerance.h5") as file:
        assert file["tolerance_widths/cheapest"].shape == (4,)


def test_files(gudgeon):
    """tolerance.h5, both csv, figures; the echo is a deck."""
    text = MOVING.replace("part    = 0 mm", "part    = 0.02 mm")
    summary, out = study(gudgeon, text)
    assert summary["figures"] == [f"figures/tolerance_{name}.png" for name in ("contributors", "histogram", "band")]
    with h5py.File(out / "tolerance.h5") as file:
        assert {"tolerance_requests", "tolerance_contributors", "tolerance_times", "tolerance_derivatives",
                "tolerance_histograms"} <= set(file)
        assert file["tolerance_times/sigma"].shape == (12,)
    rows = (out / "tolerance.csv").read_text().splitlines()
    assert len(rows) == 13
    assert rows[0].startswith("request,unit,time [s],nominal,low,high,sigma,mean,sampled_mean")
    assert len((out / "tolerance_derivatives.csv").read_text().splitlines()) == 3 * 3 * 4 + 1
    assert "[tolerance.joint]" in (out / "deck.echo").read_text()
    call(gudgeon, "check", out / "deck.echo")


@pytest.mark.parametrize("old, new, words", [
    ("a       {plus}", "aa      {plus}", "'aa' is not a parameter of the deck"),
    ("a       {plus}", "a       0.1deg", "wrong dimension of plus_minus"),
    ("a       {plus}", "a       -0.1mm", "plus_minus must not be negative"),
    ("0.05deg      uniform", "0.05deg      square", "square"),
    ("swing   request.rocker", "swing   request.locker", "unknown channel 'request.locker'"),
    ("98.3deg    98.9deg", "98.3mm     98.9deg", "wrong dimension of a limit"),
    ("98.3deg    98.9deg", "98.9deg    98.3deg", "the upper limit is below the lower one"),
    ("[analysis.kinematic]", "[tolerance.study]\nlevel = kinematic\n[analysis.dynamic]",
     "the deck has no section [analysis.kinematic]"),
    ("[analysis.kinematic]", "[analysis.dynamic]", "'request.rocker' is not a number of a run"),
    ("[tolerance.limit]", "[tolerance.joint]\nname   pin\na      disc\n[tolerance.limit]",
     "not a planar revolute joint with clearance"),
    ("[tolerance.limit]", "[tolerance]\nname   fit\nbranch   H7\n[tolerance.limit]", "a fit needs its diameter"),
])
def test_refused(gudgeon, old, new, words):
    """Errors of the tables, with their place; by every verb that reads the deck."""
    directory = scratch()
    assert old in FOUR_BAR
    path = written(directory, FOUR_BAR.replace(old, new, 1))
    for verb in ("tolerance",) if "the deck has no" in words else ("tolerance", "check"):
        run = call(gudgeon, verb, path, expect=2 if "the deck has no" in words else 3)
        assert words in run.stderr, run.stderr


def test_nothing_to_study(gudgeon):
    """A deck without tables, without scatter, without channels."""
    plain = FOUR_BAR[:FOUR_BAR.index("[tolerance]")] + FOUR_BAR[FOUR_BAR.index("[analysis"):]
    for text, words in ((plain, "the deck has no table [tolerance]"),
                        (plain + "\n[tolerance.study]\nmembers = 10\n", "nothing scatters")):
        run = call(gudgeon, "tolerance", written(scratch(), text), expect=2)
        assert words in run.stderr


SPATIAL = """
deck = 1
[scene]
title = "crank, rod and rocker in space"
space = spatial
gravity = 0 0 -9.81 m/s^2
[parameters]
L = 122 mm
r = 20 mm
h = 74 mm
[bodies]
name mass[kg] ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2] x[m] y[m] z[m] xi_axis eta_axis
crank 0.02 3.92e-5 1.97e-5 1.97e-5 0 0 0 "1 0 0" "0 1 0"
rocker 0.03 1.456e-4 2.9e-6 1.456e-4 -0.0574555772 -0.085 0.0326236544 "0.0652473088 0 0.0349111544" "-0.0349111544 0 0.0652473088"
[points]
name     body      xi       eta       zeta
a        ground    0m       0m        0m
a_2      crank     0m       0m        0m
b_2      crank     0m       0m        {r}
c_4      rocker    0m       {h/2}     0m
d_4      rocker    0m       {-h/2}    0m
d        ground    -0.04m   -0.085m   0m
[joint.revolute]
name     i    j      axis_i
main     a    a_2    "1 0 0"
side     d    d_4    "0 1 0"
[joint.distance]
name  i     j    length
rod   b_2   c_4  {L}
[driver.angle]
name    joint   angle
motor   main    {10 rad/s*t}
[tolerance]
name  plus_minus
L     0.1mm
r     0.05mm
h     0.05mm
[tolerance.study]
requests = c_4.position.x c_4.position.y rocker.velocity.z motor.moment side.force.x
points   = 20
members  = 100
[analysis.kinematic]
end = 0.6 s
[output]
every = 0.2 s
"""


@pytest.mark.parametrize("name, nominal", [("L", 122), ("h", 74)])
def test_in_space(gudgeon, name, nominal):
    """Derivatives of positions, velocities and forces in space are those of runs; what does not move has none."""
    of, _ = study(gudgeon, SPATIAL)
    step, runs = 0.02, {}
    for part in (-2, -1, 1, 2):
        runs[part], _ = study(gudgeon, SPATIAL, **{name: f"{nominal + part * step}mm"})
    for channel, found in of["tolerance"].items():
        values = {part: np.array(run["tolerance"][channel]["nominal"]["value"]) for part, run in runs.items()}
        slope = (8 * (values[1] - values[-1]) - (values[2] - values[-2])) / (12 * step * 1e-3)
        assert found["derivative"][name]["value"] == pytest.approx(slope, rel=1e-9, abs=1e-9 * np.abs(slope).max() + 1e-11), channel
    assert of["tolerance"]["c_4.position.y"]["sigma"]["value"] == [0.0] * 4


def test_a_million_members(gudgeon):
    """A million members of the four-bar take less than 10 s of one processor."""
    summary, _ = study(gudgeon, FOUR_BAR + "\n[tolerance.study]\nmembers = 1000000\npoints = 20\n")
    assert summary["tolerance_study"]["members"] == 1000000
    assert summary["tolerance_study"]["cpu_members"] < 10
    rocker = summary["tolerance"]["request.rocker"]
    assert rocker["sigma"]["sampled"][0] == pytest.approx(rocker["sigma"]["value"][0], rel=3e-3)
