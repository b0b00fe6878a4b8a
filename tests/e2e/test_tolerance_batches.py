"""Parameters that deviate together, parameters that scatter as they were measured, and rare failures: closed forms, members, errors."""

import math

import numpy as np
import pytest
from support import call, scratch, written
from test_tolerance import FOUR_BAR, slopes_of, study

HEAD = "[tolerance]\nname plus_minus distribution batch correlation\n"
WIDTH = 0.05e-3  # half that of the tolerances [m]
ROWS = FOUR_BAR[FOUR_BAR.index("[tolerance]"):FOUR_BAR.index("[tolerance.limit]")]
SLOPES = slopes_of(0.02, 0.06, 0.05, 0.07, math.radians(30))

THROWN = """deck = 1
[scene]
gravity = 0 -9.81 m/s^2
[parameters]
h = 1 m
v = 4 m/s
[bodies]
name mass[kg] inertia[kg.m^2] y vy
ball 1 0.1 {h} {v}
[tolerance]
name plus_minus distribution batch correlation
h 0.1m normal cast 0.49
v 0.5m/s normal cast 0.81
[tolerance.study]
requests = ball.position.y.final
members = 200
points = 50
[analysis.dynamic]
start = given
end = 0.5 s
[output]
every = 0.25 s
"""


def rocker_of(gudgeon, rows, more=""):
    """The study of the rocker's angle with other rows of tolerances."""
    return study(gudgeon, FOUR_BAR.replace(ROWS, rows + "\n") + more)[0]["tolerance"]["request.rocker"]


def together(distribution, a, b):
    """Rows of two lengths of one batch, and one that deviates alone."""
    return HEAD + "".join(f"{name} 0.05mm {distribution} {batch}\n" for name, batch in (
        ("a", f"cast {a}"), ("b", f"cast {b}"), ("c", "- -")))


@pytest.mark.parametrize("distribution, sigma, a, b, correlation", [
    ("normal", WIDTH / 3, 0.64, 0.36, 0.48),
    ("normal", WIDTH / 3, 1, 1, 1),
    ("uniform", WIDTH / math.sqrt(3), 0.5, 0.5, 6 / math.pi * math.asin(0.5 / 2)),
    ("uniform", WIDTH / math.sqrt(3), 0.9, 0.4, 6 / math.pi * math.asin(0.6 / 2)),
    ("two_point", WIDTH, 0.5, 0.5, 2 / math.pi * math.asin(0.5)),
])
def test_standard_deviation(gudgeon, distribution, sigma, a, b, correlation):
    """With the correlation of the distribution under a Gaussian copula; parts add up; members agree."""
    rocker = rocker_of(gudgeon, together(distribution, a, b), "\n[tolerance.study]\nmembers = 20000\npoints = 2000\n")
    s = [SLOPES[name] * sigma for name in "abc"]
    exact = math.sqrt(s[0]**2 + s[1]**2 + s[2]**2 + 2 * correlation * s[0] * s[1])
    assert rocker["sigma"]["value"][0] == pytest.approx(exact, rel=1e-4 if distribution == "two_point" else 1e-7)
    assert sum(index["linear"][0] for index in rocker["index"].values()) == pytest.approx(1)
    assert rocker["sigma"]["sampled_low"][0] < exact < rocker["sigma"]["sampled_high"][0]
    assert set(rocker["index"]) == {"a", "b", "c", "cast"}
    for index in rocker["index"].values():
        half = index["high"][0] - index["low"][0]
        # a channel that is linear in its parameters is not in their normal numbers: what is left goes to both
        assert abs(index["value"][0] - index["linear"][0]) < half + (0 if distribution == "normal" else 0.06)
    assert rocker["index"]["c"]["linear"][0] == pytest.approx((s[2] / exact)**2, rel=1e-4)
    if a == 1:
        assert rocker["index"]["a"]["linear"][0] == pytest.approx(0, abs=1e-9)
        assert rocker["index"]["cast"]["linear"][0] == pytest.approx((s[0] + s[1])**2 / exact**2, rel=1e-7)


def test_mean_of_second_order(gudgeon):
    """Parameters of one batch with r = 1 are one parameter: mean and deviation are those of a deck with one."""
    one = FOUR_BAR.replace("a       = 20 mm", "e0 = 0 mm\na = {20mm + e0}").replace("b       = 60 mm", "b = {60mm + e0}")
    one = one.replace(ROWS, "[tolerance]\nname plus_minus distribution\ne0 0.5mm normal\n\n")
    two = FOUR_BAR.replace(ROWS, HEAD + "a 0.5mm normal cast 1\nb 0.5mm normal cast 1\n\n")
    of_one, of_two = (study(gudgeon, text)[0]["tolerance"]["request.rocker"] for text in (one, two))
    for name in ("sigma", "mean"):
        assert of_two[name]["value"][0] == pytest.approx(of_one[name]["value"][0], rel=1e-7)
    shift = of_one["mean"]["value"][0] - of_one["nominal"]["value"][0]
    assert of_two["mean"]["value"][0] - of_two["nominal"]["value"][0] == pytest.approx(shift, rel=1e-4)
    assert abs(shift) > 1e-7


def test_measured_values(gudgeon):
    """Mean, deviation, limits and members are those of the values with their counts; a file says the same as lists."""
    values, counts = np.array([20.04, 19.98, 20.01, 20.02]), np.array([3, 1, 4, 2])
    rows = ("[tolerance]\nname distribution value count\n"
            f'a measured "{" ".join(map(str, values))} mm" "{" ".join(map(str, counts))}"\n')
    summary, _ = study(gudgeon, FOUR_BAR.replace(ROWS, rows + "\n") + "\n[tolerance.study]\nmembers = 20000\n")
    of = summary["tolerance_study"]["parameters"]["a"]
    mean = np.average(values, weights=counts)
    sigma = math.sqrt(np.average((values - mean)**2, weights=counts))
    assert [of[name] for name in ("lower", "upper", "mean", "sigma")] == pytest.approx(
        [19.98e-3, 20.04e-3, mean * 1e-3, sigma * 1e-3], rel=1e-12)
    rocker = summary["tolerance"]["request.rocker"]
    assert rocker["sigma"]["value"][0] == pytest.approx(abs(SLOPES["a"]) * sigma * 1e-3, rel=1e-8)
    assert rocker["sigma"]["sampled_low"][0] < rocker["sigma"]["value"][0] < rocker["sigma"]["sampled_high"][0]
    bins = np.array(rocker["histogram"]["counts"])
    parts = np.sort(bins[bins > 0]) / 20000
    assert parts == pytest.approx([0.1, 0.2, 0.3, 0.4], abs=0.015)  # four values: four bins
    directory = scratch()
    (directory / "shafts.txt").write_text("diameter[um] parts\n" + "".join(f"{v * 1e3} {n}\n" for v, n in zip(values, counts)))
    text = FOUR_BAR.replace(ROWS, "[tolerance]\nname distribution file\na measured shafts.txt\n\n") + "\n[tolerance.study]\nmembers = 20000\n"
    call(gudgeon, "tolerance", written(directory, text), "--out", directory / "out", "--quiet")
    text = (directory / "out/deck.echo").read_text()
    again, _ = study(gudgeon, text)  # the echo has numbers where the parameter stood
    assert {name: again["tolerance_study"]["parameters"]["a"][name] for name in ("lower", "upper", "mean", "sigma")} == {
        name: pytest.approx(of[name], rel=1e-12) for name in ("lower", "upper", "mean", "sigma")}


def test_runs(gudgeon):
    """The dynamic level: the height of a thrown ball is linear in height and speed."""
    summary, _ = study(gudgeon, THROWN)
    of = summary["tolerance"]["ball.position.y.final"]
    parts = np.array([0.1, 0.5 * 0.5]) / 3
    exact = math.sqrt(parts @ parts + 2 * 0.63 * parts[0] * parts[1])
    assert of["sigma"]["value"][0] == pytest.approx(exact, rel=1e-6)
    assert of["sigma"]["sampled_low"][0] < exact < of["sigma"]["sampled_high"][0]
    shares = {"h": 0.51 * parts[0]**2, "v": 0.19 * parts[1]**2, "cast": (0.7 * parts[0] + 0.9 * parts[1])**2}
    for name, share in shares.items():
        index = of["index"][name]
        assert index["linear"][0] == pytest.approx(share / exact**2, rel=1e-6)
        assert index["low"][0] - 0.1 < share / exact**2 < index["high"][0] + 0.1


@pytest.mark.parametrize("rows, words", [
    (HEAD + "a 0.05mm normal cast 1\nb 0.05mm normal - -\n", "batch 'cast' has one parameter only"),
    (HEAD + "a 0.05mm normal - 0.5\nb 0.05mm normal - -\n", "correlation is given without what it belongs to"),
    (HEAD + "a 0.05mm normal cast 1.5\nb 0.05mm normal cast -\n", "correlation"),
    (HEAD + "a 0.05mm normal b 1\nb 0.05mm normal b -\n", "a batch has the name of a parameter"),
    ("[tolerance]\nname fit diameter batch\na H7/f7 20mm cast\nb H7/f7 20mm cast\n", "a fit is of two parts"),
    ("[tolerance]\nname distribution\na measured\n", "parameter 'a' has no measured values"),
    ('[tolerance]\nname distribution value\na measured "1 2 kg"\n', "wrong dimension of value"),
    ('[tolerance]\nname distribution value count\na measured "20 21 mm" "1"\n', "1 counts of 2 values"),
    ('[tolerance]\nname distribution value count\na measured "20 21 mm" "1 0"\n', "a count must be positive"),
    ('[tolerance]\nname distribution value count\na measured "20 21 mm" "1 2 mm"\n', "a count has no unit"),
    ('[tolerance]\nname distribution plus_minus value\na measured 1mm "20 21 mm"\n', "plus_minus is given without what it belongs to"),
    ('[tolerance]\nname distribution plus_minus value\na normal 1mm "20 21 mm"\n', "value is given without what it belongs to"),
])
def test_refused(gudgeon, rows, words):
    """Errors of the rows, with their place."""
    run = call(gudgeon, "tolerance", written(scratch(), FOUR_BAR.replace(ROWS, rows + "\n")), expect=3)
    assert words in run.stderr and "^" in run.stderr, run.stderr


STACK = """deck = 1
[scene]
gravity = 0 0 m/s^2
[parameters]
a = 20 mm
b = 20 mm
[bodies]
name mass[kg] inertia[kg.m^2] x
top 0.1 1e-5 {a + b}
[points]
name body xi
foot ground 0mm
head top 0mm
[joint.translational]
name i j axis
guide foot head x
[driver.distance]
name i j distance
rest foot head {a + b}
[tolerance]
name plus_minus distribution batch correlation
a 0.03mm normal turned 0.5
b 0.03mm normal turned 0.5
[tolerance.limit]
name channel lower upper
high top.position.x LOWER UPPER
[tolerance.study]
members = 100
points = 10
rare = RARE
seed = SEED
[analysis.kinematic]
end = 1 s
[output]
every = 1 s
"""


def stack(gudgeon, lower, upper, seed=1, rare=4000):
    """Failures of a stack of two normal rollers whose correlation is 0.5: standard deviation sqrt(3) times 10 um."""
    text = STACK.replace("LOWER", lower).replace("UPPER", upper).replace("SEED", str(seed)).replace("RARE", str(rare))
    return study(gudgeon, text)[0]["tolerance"]["top.position.x"]["failures"]


def beyond(deviations):
    """Part of a normal distribution beyond so many standard deviations."""
    return 0.5 * math.erfc(deviations / math.sqrt(2))


@pytest.mark.parametrize("lower, upper, exact", [
    ("39.91mm", "40.085mm", beyond(9 / math.sqrt(3)) + beyond(8.5 / math.sqrt(3))),
    ("-", "40.07mm", beyond(7 / math.sqrt(3))),
    ("39.99mm", "-", beyond(1 / math.sqrt(3))),
    ("40.02mm", "-", 1 - beyond(2 / math.sqrt(3))),
])
def test_rare_failures(gudgeon, lower, upper, exact):
    """Parts per ten million, by four thousand members; also where failures are not rare."""
    found = stack(gudgeon, lower, upper)
    assert found["value"] == pytest.approx(exact, rel=0.15)
    assert found["low"] < found["value"] < found["high"]


def test_rare_failures_that_cannot_be(gudgeon):
    """Where no member fails the interval starts at zero and ends above it."""
    found = stack(gudgeon, "30mm", "-", rare=1000)
    assert found["low"] == found["value"] == 0 and found["high"] == pytest.approx(3 / 100)


def test_intervals_of_rare_failures(gudgeon):
    """The stated interval of 95 % holds: in 21 of 25 repeats or more."""
    exact = beyond(9 / math.sqrt(3)) + beyond(8.5 / math.sqrt(3))
    found = [stack(gudgeon, "39.91mm", "40.085mm", seed, 1000) for seed in range(25)]
    assert sum(one["low"] < exact < one["high"] for one in found) >= 21


def test_rare_failures_of_a_linkage(gudgeon):
    """A rocker beyond its limits in one of ten thousand: by importance sampling, and counted over half a million members."""
    text = FOUR_BAR.replace("98.3deg    98.9deg", "98.47deg    98.72deg").replace("truncated", "normal")
    text += "\n[tolerance.study]\nmembers = 500000\npoints = 10\nrare = 20000\n"
    rocker = study(gudgeon, text)[0]["tolerance"]["request.rocker"]
    counted = 1 - np.array([rocker["yield"]["value"], rocker["yield"]["low"], rocker["yield"]["high"]])
    failures = rocker["failures"]
    assert 5e-6 < counted[0] < 2e-3, counted
    assert failures["low"] < counted[1] and counted[2] < failures["high"]  # the intervals overlap
    assert failures["high"] - failures["low"] < counted[1] - counted[2]  # and that of importance sampling is the narrower one


def test_rare_failures_of_runs(gudgeon):
    """Refused: each member would be a run."""
    run = call(gudgeon, "tolerance", written(scratch(), THROWN.replace("points = 50", "rare = 100")), expect=2)
    assert "needs the kinematic level" in run.stderr
