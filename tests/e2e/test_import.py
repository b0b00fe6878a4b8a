"""Adams datasets: models with every statement that a deck can have, imported, run, and held against closed forms and scipy."""

import functools
import math
import os

import h5py
import numpy as np
import pytest
from published_series import AT_END
from scipy.integrate import solve_ivp
from scipy.interpolate import Akima1DInterpolator
from support import ROOT, call, scratch, written

MODELS = ROOT / "tests" / "adams"
INCH = 0.0254


@functools.cache
def imported(program, name, end="1s", every="10ms", tolerance="1e-10"):
    """The run of an imported model, and what the import said."""
    folder = scratch()
    said = call(program, "import", MODELS / f"{name}.adm", cwd=folder).stdout
    call(program, "run", f"{name}.deck", "--set", f"end={end}", "--set", f"every={every}", "--tolerance", tolerance, "--quiet", cwd=folder)
    return h5py.File(folder / "outputs" / name / "run.h5"), said


def column(run, room, quantity, item):
    """All components of a quantity of an item."""
    names = [n.decode() for n in run[f"{room}/names"][:]]
    return run[f"{room}/{quantity}"][:, names.index(item)]


def test_pendulum_with_inertia_told_elsewhere(gudgeon):
    """The tensor is that about the frame of the part; the speed at the start is that of the joint about its axis, which is -y."""
    run, said = imported(gudgeon, "pendulum")
    about_hinge = 0.25 - 2 * 0.1**2 + 2 * 0.3**2
    t = run["time"][:]

    def rates(_, y):
        return [y[1], -2 * 9.80665 * 0.3 * np.cos(y[0]) / about_hinge]

    want = solve_ivp(rates, (0, 1), [0.0, 2.0], t_eval=t, rtol=1e-12, atol=1e-12).y[0]
    r = column(run, "bodies", "position", "swinging_bar")
    assert np.abs(r[:, 0] - 0.3 * np.cos(want)).max() < 1e-7
    assert np.abs(r[:, 2] - 1 - 0.3 * np.sin(want)).max() < 1e-7
    assert "the whole mechanism was converted" in said
    assert "PART_99" not in said  # behind END


def test_slider_crank_in_any_order(gudgeon):
    run, _ = imported(gudgeon, "slider_crank", every="1ms")
    t = run["time"][:]
    angle = 10 * np.pi * t
    x = 0.1 * np.cos(angle) + np.sqrt(0.16 - (0.1 * np.sin(angle)) ** 2)
    assert np.abs(column(run, "bodies", "position", "PART_4")[:, 0] - x).max() < 1e-9
    assert np.abs(column(run, "forces", "force", "SFORCE_1")[:, 0] + 20 + 10 * np.sin(4 * np.pi * t)).max() < 1e-9
    power = column(run, "drivers", "power", "motor") + column(run, "forces", "power", "SFORCE_1")
    kinetic = np.gradient(run["energy/kinetic"][:], t, edge_order=2)
    assert np.abs(power - kinetic)[2:-2].max() < 0.002 * np.abs(power).max()


def test_springs_in_inches_and_pounds(gudgeon):
    """SPRINGDAMPER, and the same forces as expressions, against the equations in the dataset's own units."""
    run, said = imported(gudgeon, "springs", tolerance="1e-11")
    t = run["time"][:]
    smooth = lambda u: np.clip(u, 0, 1) ** 2 * (3 - 2 * np.clip(u, 0, 1))  # noqa: E731

    def solve(force, start, inertia):
        rates = lambda time, y: [y[1], force(time, *y) / inertia]  # noqa: E731
        return solve_ivp(rates, (0, 1), start, t_eval=t, method="DOP853", rtol=1e-12, atol=1e-12, max_step=5e-3).y[0]

    g = -38.60886
    spring = solve(lambda _, z, v: g - 40 * (z - 10) - 0.3 * v + 2, [12.0, 5.0], 0.1)
    hard = solve(
        lambda s, z, v: g - 40 * (z - 10) - 2 * (z - 10) ** 3 - 0.3 * v + 1.5 * np.sin(6 * s) + 3 * smooth((s - 0.2) / 0.3), [12.0, 5.0], 0.1
    )
    stop = solve(lambda _, z, v: g + 400 * max(10 - z, 0) ** 1.5, [12.0, -20.0], 0.1)
    wheel = solve(lambda _, a, w: -50 * (a - np.pi / 18) - 0.2 * w + 4, [np.pi / 6, 3.0], 0.4)
    for name, want in (("PART_2", spring), ("PART_3", hard), ("PART_6", stop)):
        z = column(run, "bodies", "position", name)[:, 2] / INCH
        assert np.abs(z - want).max() < 1e-6, name
    for name in ("SPRINGDAMPER_3", "SFORCE_4"):
        angle = column(run, "forces", "angle", name) + np.pi / 6
        assert np.abs(angle - wheel).max() < 1e-6, name
    spin = column(run, "bodies", "angular_velocity", "PART_6")[:, 2]
    assert np.abs(spin - 0.25 * t**2 / 0.4).max() < 1e-7
    assert "the whole mechanism was converted" in said


def fmm_spline(x, y):
    """The spline of Forsythe, Malcolm and Moler, by its definition: third derivatives of the first and the last interval are those of
    the cubics through the four samples there. A cubic spline is a straight sum of truncated cubes with that many conditions."""
    x, y = np.array(x, float), np.array(y, float)
    knots = x[1:-1]
    basis = lambda s: np.stack([s**0, s, s**2, s**3, *[np.maximum(s - k, 0) ** 3 for k in knots]], axis=-1)  # noqa: E731
    third = np.zeros((2, 4 + len(knots)))
    third[:, 3] = 6
    third[1, 4:] = 6
    want = [6 * np.polyfit(x[part], y[part], 3)[0] for part in (slice(None, 4), slice(-4, None))]
    weights = np.linalg.solve(np.vstack([basis(x), third]), np.concatenate([y, want]))
    return lambda s: basis(np.asarray(s, float)) @ weights


def test_splines(gudgeon):
    """CUBSPL and AKISPL of the length of a spring and of the time, in a motion and in forces, against scipy's Akima and a spline
    made of its definition; what a deck has no words for is left out with its reason."""
    run, said = imported(gudgeon, "splines")
    t = run["time"][:]
    places, tensions = [60, 80, 90, 100, 120, 150, 200], [-70, -15, -4, 0, 6, 22, 90]
    spring = Akima1DInterpolator(places, tensions)
    beats = [0, 0.5, 1, 1.5, 2], [0, 2, -1, 3, 0]
    pull = fmm_spline(*beats)

    def rates(time, y):
        return [y[1], (-spring(y[0]) - 0.002 * y[1] + 3 * pull(time)) / 2 * 1000]

    want = solve_ivp(rates, (0, 1), [110.0, 50.0], t_eval=t, rtol=1e-11, atol=1e-11, max_step=1e-3).y[0]
    assert want.min() < 90 and want.max() > 120  # over several pieces
    z = column(run, "bodies", "position", "PART_2")[:, 2] * 1000
    assert np.abs(z - want).max() < 1e-6
    way = fmm_spline([0, 0.1, 0.25, 0.5, 0.7, 1.0], [0, 4, 20, 60, 75, 80])(t)
    assert np.abs(column(run, "bodies", "position", "PART_3")[:, 2] * 1000 - way).max() < 1e-9
    spin = Akima1DInterpolator(*beats).antiderivative()(t) * 1000 / 150
    turning = column(run, "bodies", "angular_velocity", "PART_4")
    assert np.abs(np.abs(turning).max(axis=1) - np.abs(spin)).max() < 1e-8
    for words in ("SPLINE/3: it has fewer than 4 samples", "the spline of CUBSPL does not exist", "a derivative by AKISPL is not supported",
                  "cubic_2 ends at its last sample, where Adams extrapolates"):
        assert words in said
    assert "SPLINE/1" not in said  # goes on along its tangents in both


def test_stops_drags_and_gears(gudgeon):
    """Damped IMPACT and BISTOP, forces of components of motion, GEAR and COUPLER, against the equations in the dataset's own units."""
    run, said = imported(gudgeon, "stops")
    assert "the whole mechanism was converted" in said
    t = run["time"][:]

    def stop(p, v, k, e, c, d):
        u = np.clip(p / d, 0, 1)
        return max(k * max(p, 0) ** e + c * u**2 * (3 - 2 * u) * v, 0)

    def solve(force, start):
        rates = lambda _, y: [y[1], 1e3 * force(*y)]  # noqa: E731
        return solve_ivp(rates, (0, 1), start, t_eval=t, rtol=1e-11, atol=1e-9, max_step=1e-3).y[0]

    falling = solve(lambda z, v: stop(50 - z, -v, 400, 1.5, 3, 0.5) - 9.80665, [60.0, 0.0])
    between = solve(lambda z, v: stop(50 - z, -v, 400, 1.2, 2, 0.3) - stop(z - 75, v, 400, 1.2, 2, 0.3), [60.0, 300.0])
    for name, want in (("PART_2", falling), ("PART_3", between)):
        z = 1e3 * column(run, "bodies", "position", name)[:, 2]
        assert np.ptp(want) > 5
        assert np.abs(z - want).max() < 2e-4, name
    velocity = 1e3 * column(run, "bodies", "velocity", "PART_4")
    assert np.abs(velocity[:, 0] - 400 * np.exp(np.exp(-t) - 1)).max() < 1e-3
    assert np.abs(velocity[:, 1] - 300 / (1 + 1.5 * t)).max() < 1e-3
    spin = {k: column(run, "bodies", "angular_velocity", f"PART_{k}")[:, 2] for k in (4, 5, 6, 7)}
    assert np.abs(spin[4] - 10 / 3 * (1 - np.exp(-1.5 * t))).max() < 1e-6
    first = 1e4 / (2e3 + 4 * 3e3 + 4 / 9 * 4e3) * t
    for k, ratio in ((5, 1), (6, -2), (7, 2 / 3)):
        assert np.abs(spin[k] - ratio * first).max() < 1e-7, k


def test_couplers(gudgeon):
    """COUPLER of two and three joints, angles and displacements, by TYPE and SCALES: closed forms; what has a FUNCTION is left out."""
    run, said = imported(gudgeon, "couplers")
    t = run["time"][:]
    assert "COUPLER/3: a FUNCTION of its own is not supported" in said and "(1 item)" in said
    c, inertia, torque = np.array([1, 1, -2]), np.array([0.02, 0.05, 0.03]), np.array([1.5, -0.4, 0])
    rate = (torque - c * (c @ (torque / inertia)) / (c**2 @ (1 / inertia))) / inertia
    for name, acceleration in zip(("PART_2", "PART_3", "PART_4"), rate * [1, 1, -1]):
        assert np.abs(column(run, "bodies", "spin", name)[:, 2] - acceleration * t).max() < 1e-8, name
    arm = 0.025
    fall = 2 * 9.80665 / (2 + 0.04 / arm**2)
    assert np.abs(column(run, "bodies", "position", "PART_5")[:, 2] + fall * t**2 / 2).max() < 1e-9
    assert np.abs(column(run, "bodies", "spin", "PART_6")[:, 2] - fall * t / arm).max() < 1e-8
    assert np.abs(column(run, "bodies", "position", "PART_6")[:, 2] + 9.80665 * t**2 / 2).max() < 1e-8  # slides freely


def test_shafts_and_racks(gudgeon):
    """CONVEL keeps the speeds of two shafts equal, RACKPIN lets a rack turn its pinion as it falls; closed forms."""
    run, said = imported(gudgeon, "shafts")
    t = run["time"][:]
    driving, driven = (column(run, "bodies", "spin", f"PART_{k}") for k in (2, 3))
    assert np.abs(driving[:, 2] - (8 - 0.05 / 0.007 * t)).max() < 1e-7
    assert np.abs(driven[:, 2] - driving[:, 2]).max() < 1e-8
    assert np.abs(column(run, "joints", "bend", "JOINT_2") - np.radians(35)).max() < 1e-7
    fall = -9.81 * 3 / (3 + 0.002 / 0.08**2)
    assert np.abs(column(run, "bodies", "position", "PART_5") - np.stack([1.9 + fall * t**2 / 2, 0 * t - 0.08, 0 * t], 1)).max() < 1e-8
    assert np.abs(column(run, "bodies", "spin", "PART_4")[:, 2] - fall * t / 0.08).max() < 1e-7
    assert "line 35, column 1: JOINT/7: the marker of the pinion" in said and "(1 item)" in said


def test_twist_of_a_constant_velocity_joint_is_told(gudgeon):
    """Shafts twisted at the start, or whose axes point the same way, are taken as they are, and the list says so."""
    folder = scratch()
    model = (MODELS / "shafts.adm").read_text()
    (folder / "twisted.adm").write_text(model.replace("MARKER/23, PART = 2, QP = 0, 0, 0, REULER = 0D, 180D, 0D",
                                                      "MARKER/23, PART = 2, QP = 0, 0, 0, REULER = 20D, 180D, 0D"))
    assert "(constant velocity) keeps the initial twist" in call(gudgeon, "import", "twisted.adm", cwd=folder).stdout
    (folder / "turned.adm").write_text(model.replace("REULER = 0D, 180D, 0D", "REULER = 0D, 0D, 0D"))
    said = call(gudgeon, "import", "turned.adm", cwd=folder).stdout
    assert "do not point away from one another; they are used as the shafts" in said
    (folder / "far.adm").write_text(model.replace("PD = 160, I = 41", "PD = 150, I = 41"))
    assert "the distance of the axes is 0.08 m, but half of PD is used" in call(gudgeon, "import", "far.adm", cwd=folder).stdout
    (folder / "none.adm").write_text(model.replace("RACKPIN, PD = 160, I = 41", "RACKPIN, I = 41"))
    assert "a pitch diameter PD" in call(gudgeon, "import", "none.adm", cwd=folder, expect=3).stderr


def test_joint_primitives(gudgeon):
    """Primitives against the joint that they make up, closed forms, and a deck with the joint."""
    run, _ = imported(gudgeon, "primitives")
    t = run["time"][:]
    made, joint = (column(run, "bodies", "position", name) for name in ("PART_2", "PART_3"))
    assert np.abs(made + [3, 0, 0] - joint).max() < 1e-8
    lean = np.radians(40)
    way = -0.5 * 9.81 * np.cos(lean) * t**2
    slider = column(run, "bodies", "position", "PART_4")
    assert np.abs(slider - [6, 0, 0] - np.outer(way, [np.sin(lean), 0, np.cos(lean)])).max() < 1e-9
    plate = column(run, "bodies", "position", "PART_6")
    assert np.abs(plate - [12, 0, 0] - np.outer(t, [1, 0, 0])).max() < 1e-9
    assert np.abs(column(run, "bodies", "angular_velocity", "PART_6") - [0, 0, 2]).max() < 1e-9
    deck = """deck = 1
[scene]
title = "cross"
space = spatial
gravity = 0 0 -9.81 m/s^2
[bodies]
name mass[kg] ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2] z[m] wx[rad/s] wy[rad/s]
bob 1 0.1 0.2 0.3 -0.4 1 2
[points]
name body zeta[m]
hook ground 0
eye bob 0.4
[joint.universal]
name i j axis_i axis_j
cross hook eye "1 0 0" "0 -1 0"
[analysis.dynamic]
end = 1 s
tolerance = 1e-10
[output]
every = 10 ms
channels = bob.position
"""
    folder = scratch()
    call(gudgeon, "run", written(folder, deck), "--out", folder / "out", "--quiet")
    want = column(h5py.File(folder / "out" / "run.h5"), "bodies", "position", "bob")
    assert np.abs(column(run, "bodies", "position", "PART_5") - [9, 0, 0] - want).max() < 1e-7


def test_motions(gudgeon):
    """Every MOTION, the screw, forces that turn with a body, the Hooke joint; closed forms."""
    run, _ = imported(gudgeon, "drives")
    t = run["time"][:]
    u = np.clip((t - 0.1) / 0.2, 0, 1)
    speed = 4 * u**2 * (3 - 2 * u) + 2 * np.sin(3 * t) + 0.5 * t**2
    assert np.abs(column(run, "bodies", "angular_velocity", "PART_2")[:, 2] - speed).max() < 1e-6
    u = np.clip((t - 0.1) / 0.3, 0, 1)
    angle = np.pi / 9 + np.pi / 3 * u**3 * (10 - 15 * u + 6 * u**2)
    e = column(run, "bodies", "orientation", "PART_3")
    assert np.abs(2 * np.arctan2(e[:, 3], e[:, 0]) - angle).max() < 1e-8
    u = np.clip(t / 0.5, 0, 1)
    z = 0.05 + 0.02 * (1 - np.cos(np.pi * u)) / 2
    nut = column(run, "bodies", "position", "PART_4")[:, 2]
    assert np.abs(nut - z).max() < 1e-8
    rate = column(run, "bodies", "velocity", "PART_4")[:, 2]
    assert np.abs(column(run, "bodies", "angular_velocity", "PART_4")[:, 2] - 2 * np.pi * rate / 0.005).max() < 1e-4
    y = column(run, "bodies", "position", "PART_5")[:, 1]
    assert np.abs(y + 0.01 - 0.03 * t + 0.1 * t**2).max() < 1e-8

    def plate(time, s):
        push = -3 if time < 0.25 else 5
        return [s[2], s[3], (2 + push * np.sin(time)) / 2, (-4 * time - push * np.cos(time)) / 2]

    states = np.array([0.0, 0, 0, 0])
    half = solve_ivp(plate, (0, 0.25 - 1e-15), states, rtol=1e-11, atol=1e-12, t_eval=t[t < 0.25]).y
    at = solve_ivp(plate, (0, 0.25 - 1e-15), states, rtol=1e-11, atol=1e-12).y[:, -1]
    rest = solve_ivp(plate, (0.25, 1), at, rtol=1e-11, atol=1e-12, t_eval=t[t >= 0.25]).y
    r = column(run, "bodies", "position", "PART_6") - [4, 0, 0]
    assert np.abs(r[:, :2] - np.hstack([half, rest])[:2].T).max() < 1e-6
    first = column(run, "joints", "angular_rate", "JOINT_8") if "angular_rate" in run["joints"] else None
    first = column(run, "bodies", "angular_velocity", "PART_7")[:, 2] if first is None else first
    second = column(run, "bodies", "spin", "PART_8")[:, 2]
    turned = column(run, "bodies", "orientation", "PART_7")
    theta = 2 * np.arctan2(turned[:, 3], turned[:, 0])
    lean = np.radians(30)
    ratio = np.cos(lean) / (1 - (np.sin(lean) * np.cos(theta)) ** 2)
    other = np.cos(lean) / (1 - (np.sin(lean) * np.sin(theta)) ** 2)
    assert min(np.abs(second / first - ratio).max(), np.abs(second / first - other).max()) < 1e-6
    assert np.abs(column(run, "bodies", "position", "PART_9") - [6, 0, 0]).max() < 1e-10
    ball = column(run, "bodies", "position", "PART_10") - [6, 0, 0]
    assert np.abs(np.linalg.norm(ball, axis=1) - 0.1).max() < 1e-8


@pytest.mark.parametrize("part, case, limit", [(2, "universal_3", 2e-3), (3, "distance_2", 2e-5), (4, "torsion_spring_1", 2e-5)])
def test_tilted_markers(gudgeon, part, case, limit):
    """Arms of a Hooke joint, a distance as a constraint, a rotational spring as Adams/View writes it: series of Adams itself."""
    run, said = imported(gudgeon, "tilted", end="5s")
    assert "GCON/1" not in said and "GCON/2: user-defined constraints except distances are not supported" in said
    for quantity in ("position", "velocity", "acceleration"):
        values = column(run, "bodies", quantity, f"PART_{part}")
        assert np.abs(values[-1] - AT_END[case][quantity]).max() < limit*max(1.0, np.abs(values).max()), quantity


ADAMS = {  # of Adams/Solver itself, its case Universal_Case03 in the tests of Project Chrono: time, place of the centre of mass
    0.25: (1.39846, 1.39847, -0.297648),
    0.5: (1.17412, 1.17480, -1.11414),
    0.75: (0.416384, 0.423327, -1.90982),
    1.0: (-0.636240, -0.614073, -1.79391),
}


def test_as_adams_exports_it(gudgeon):
    """Lines that go on with & and commas, HOOKE against Adams itself, ROTATIONAL, IC, and arguments that no deck has."""
    run, said = imported(gudgeon, "exported")
    t = run["time"][:]
    swing = column(run, "bodies", "position", "swing")
    for time, place in ADAMS.items():  # which drifts by some 1e-5
        assert np.abs(swing[np.argmin(np.abs(t - time))] - place).max() < 2e-5, time
    inertia = 0.4 + 2.5 * 0.3**2
    degrees = 180 / np.pi

    def rates(_, y):  # about y; the lever hangs along x
        spring = -2 * degrees * (y[0] - np.pi / 18) - 0.01 * degrees * y[1]
        return [y[1], (spring + 2.5 * 9.80665 * 0.3 * np.cos(y[0])) / inertia]

    want = solve_ivp(rates, (0, 1), [0.0, -1.5], t_eval=t, rtol=1e-12, atol=1e-12).y[0]
    lever = column(run, "bodies", "position", "lever")
    assert np.abs(lever[:, 0] - 10 - 0.3 * np.cos(want)).max() < 1e-7
    assert np.abs(lever[:, 2] + 0.3 * np.sin(want)).max() < 1e-7
    assert np.ptp(want) > 0.1
    assert np.abs(column(run, "bodies", "position", "block") - np.outer(0.75 * t, [1, 0, 0]) - [20, 0, 0]).max() < 1e-9
    assert np.abs(column(run, "bodies", "position", "other_block") - np.outer(-0.5 * t, [1, 0, 0]) - [20, 5, 0]).max() < 1e-9
    assert run.attrs["title"] in ("Adams/View model name: as exported", b"Adams/View model name: as exported")
    left = said[said.index("not supported, omitted from the deck (2 items)") : said.index("Adams settings")]
    assert "JOINT/4: its DELTA has no equivalent in a deck" in left
    assert "GFORCE/1: its components are missing, or user code outside the dataset" in left


def smooth_step(t, x0, h0, x1, h1, blend):
    u = min(max((t - x0) / (x1 - x0), 0), 1)
    return h0 + (h1 - h0) * blend(u)


EXPRESSIONS = {  # of Adams, and what they are by its description
    "-2**2*TIME": lambda t: -4 * t,
    "2**3**2/2**-1/4*2": lambda t: 512,
    "8/4/2+8/4*2-1-1": lambda t: 3,
    "30D+5*TIME": lambda t: math.pi / 6 + 5 * t,
    "360.0d*time-20D-5": lambda t: 2 * math.pi * t - math.pi / 9 - 5,
    "1E2*.5*TIME-3.*TIME+1.e-1": lambda t: 47 * t + 0.1,
    "-(TIME-2)**3/(-4)-TIME*-2": lambda t: (t - 2) ** 3 / 4 + 2 * t,
    "SQRT(TIME+1)*LOG(TIME+1)+LOG10(TIME+2)": lambda t: math.sqrt(t + 1) * math.log(t + 1) + math.log10(t + 2),
    "ATAN2(TIME-0.5,0.3)+ATAN(TIME)+ASIN(TIME/2)+ACOS(TIME/2)": lambda t: math.atan2(t - 0.5, 0.3) + math.atan(t) + math.pi / 2,
    "SINH(TIME)+COSH(TIME)+TANH(TIME)+TAN(TIME)": lambda t: math.exp(t) + math.tanh(t) + math.tan(t),
    "ABS(TIME-0.5)+MIN(TIME,0.3)+MAX(TIME,0.7)": lambda t: abs(t - 0.5) + min(t, 0.3) + max(t, 0.7),
    "STEP(-TIME,-0.6,1,-0.2,-3)": lambda t: smooth_step(-t, -0.6, 1, -0.2, -3, lambda u: u**2 * (3 - 2 * u)),
    "STEP5(TIME,0.2,1,0.6,10d)": lambda t: smooth_step(t, 0.2, 1, 0.6, math.pi / 18, lambda u: u**3 * (10 - 15 * u + 6 * u**2)),
    "HAVSIN(TIME,0.2,1,0.6,-3)": lambda t: smooth_step(t, 0.2, 1, 0.6, -3, lambda u: (1 - math.cos(math.pi * u)) / 2),
    "IF(0.525-TIME:1,2,IF(TIME-0.225:3,4,5))": lambda t: 1 if t > 0.525 else 3 if t < 0.225 else 5,
    "SIGN(3,TIME-0.525)+DIM(TIME,0.4)": lambda t: math.copysign(3, t - 0.525) + max(t - 0.4, 0),
    "POLY(TIME,0.1,1,2,-3,4)": lambda t: 1 + 2 * (t - 0.1) - 3 * (t - 0.1) ** 2 + 4 * (t - 0.1) ** 3,
    "SHF(TIME,25D,PI,360D,0.4,5)": lambda t: math.pi * math.sin(2 * math.pi * (t - math.radians(25)) - 0.4) + 5,
    "FORCOS(TIME,0.1,5,1,2,3)": lambda t: 1 + 2 * math.cos(5 * (t - 0.1)) + 3 * math.cos(10 * (t - 0.1)),
    "FORSIN(TIME,0.1,5,1,2,3)": lambda t: 1 + 2 * math.sin(5 * (t - 0.1)) + 3 * math.sin(10 * (t - 0.1)),
    "BISTOP(TIME,0,0.3,0.5,100,1.5,0,0.1)": lambda t: 100 * (max(0.3 - t, 0) ** 1.5 - max(t - 0.5, 0) ** 1.5),
}


def test_expressions(gudgeon):
    """Every function and operator that has words in a deck, as a force on a slider, against what Adams says of it."""
    text = "expressions\nUNITS/SYSTEM = MKS\nPART/1, GROUND\nMARKER/1, PART = 1\n"
    for k, expression in enumerate(EXPRESSIONS, 2):
        text += f"PART/{k}, MASS = 1, CM = {k}, IP = 1, 1, 1, QG = {k}, 0, 0\nMARKER/{k}, PART = {k}\nMARKER/{1000 + k}, PART = 1, QP = {k}, 0, 0\n"
        text += f"JOINT/{k}, TRANSLATIONAL, I = {k}, J = {1000 + k}\nSFORCE/{k}, TRANSLATION, ACTIONONLY, I = {k}, J = 1, FUNCTION = {expression}\n"
    folder = scratch()
    (folder / "e.adm").write_text(text + "END\n")
    assert "the whole mechanism was converted" in call(gudgeon, "import", "e.adm", cwd=folder).stdout
    call(gudgeon, "run", "e.deck", "--quiet", cwd=folder)
    run = h5py.File(folder / "outputs" / "e" / "run.h5")
    for k, (expression, meaning) in enumerate(EXPRESSIONS.items(), 2):
        force = column(run, "forces", "force", f"SFORCE_{k}")[:, 2]
        assert np.abs(force - [meaning(t) for t in run["time"][:]]).max() < 1e-9, expression


def test_a_directory_is_made(gudgeon):
    """The directory that `--out` names is made, those above it too, as for a run."""
    place = scratch() / "new" / "room"
    call(gudgeon, "import", ROOT / "tests" / "adams" / "splines.adm", "--out", place)
    assert (place / "splines.deck").exists()
    blocked = scratch() / "file"
    blocked.write_text("")
    done = call(gudgeon, "import", ROOT / "tests" / "adams" / "splines.adm", "--out", blocked / "in", expect=9)
    assert "cannot make the directory" in done.stderr


def test_import_takes_time_in_proportion(gudgeon):
    """Thousands of statements, and thousands of lines of one statement: eight times as many take less than 20 times as long (64 by the square)."""
    folder = scratch()
    spent = []
    for n in (2000, 16000):
        parts = "".join(f"PART/{k}, MASS = 1, CM = {k}, IP = 1, 1, 1, QG = {k}, 0, 0\nMARKER/{k}, PART = {k}\n" for k in range(2, n // 4))
        spline = "SPLINE/1, X = 0\n" + "".join(f", {k}, {k + 0.5}\n" for k in range(1, 5 * n)) + ", Y = 1, 2\n"
        (folder / f"m{n}.adm").write_text("many\nUNITS/SYSTEM = MKS\nPART/1, GROUND\n" + parts + spline + "END\n")
        times = []
        for k in range(2):   # the lesser: others use the machine too
            began = os.times().children_user
            assert "SPLINE/1" in call(gudgeon, "import", f"m{n}.adm", *(["--out", f"again{n}.deck"] if k else []), cwd=folder).stdout
            times.append(os.times().children_user - began)
        spent.append(min(times))
    assert spent[1] < 20 * max(spent[0], 0.05), spent


def test_elastic_elements(gudgeon):
    """BUSHING, FIELD and BEAM against their linear equations in the units of the dataset: mm, kg, s."""
    run, said = imported(gudgeon, "elastic", tolerance="1e-11")
    assert "the whole mechanism was converted" in said
    t = run["time"][:]

    def swing(mass, k, c, force, start):
        """Motion of mass x'' = force - k x - c x', K and C matrices, from given x and x'."""
        n = len(force)
        def rates(_, y):
            return np.r_[y[n:], np.linalg.solve(mass, force - k @ y[:n] - c @ y[n:])]
        return solve_ivp(rates, (0, t[-1]), start, t_eval=t, rtol=1e-12, atol=1e-13).y[:n]

    newton = 1e3  # kg mm/s^2
    k, c, f = newton * np.array([0.8, 1.8, 3.2]), newton * np.array([0.004, 0, 0.01]), newton * np.array([1, -2, 0.5])
    want = swing(2 * np.eye(3), np.diag(k), np.diag(c), f, np.zeros(6))
    r = column(run, "bodies", "position", "PART_2") * 1e3
    assert np.abs(r[:, [1, 2, 0]].T - want).max() < 1e-6 * np.abs(want).max()  # x, y, z of J are y, z, x of the world
    want = swing(np.array([[1.5e4]]), newton * np.array([[6e3]]), newton * np.array([[20.0]]), newton * np.array([9e3]), np.zeros(2))[0]
    assert want.max() > 2.0
    assert np.abs(column(run, "forces", "rotation", "BUSHING_1")[:, 2] - want).max() < 1e-6
    k = newton * np.array([[0.5, 0.2], [0.2, 0.4]])
    want = swing(np.eye(2), k, 0.002 * k, k @ [3, -1], np.zeros(4))
    r = column(run, "bodies", "position", "PART_3") * 1e3
    assert np.abs(r[:, :2].T - [[1000], [0]] - want).max() < 1e-6 * np.abs(want).max()
    length, bending = 400.0, 7e4 * 450
    phi = 12 * bending * 1.1 / (2.6e4 * 80 * length**2)
    k = newton * bending / (length**3 * (1 + phi)) * np.array([[12, -6 * length], [-6 * length, (4 + phi) * length**2]])
    want = swing(np.diag([0.5, 800.0]), k, 1e-4 * k, np.zeros(2), np.array([0, 0, 20.0, 0]))[0]
    r = column(run, "bodies", "position", "PART_4")[:, 2] * 1e3
    assert np.abs(r - want).max() < 1e-4 * np.abs(want).max()


def test_contacts(gudgeon):
    """A ball falls on a plane by IMPACT, one slides on the face of a box, two meet on one line; what is assumed and omitted is listed."""
    run, said = imported(gudgeon, "contacts", end="0.15s", every="0.5ms")
    rows = run["row_kind"][:] == 0
    t = run["time"][rows]

    def impact(_, y):  # N, mm, s
        depth = 20 - y[0]
        share = min(max(depth, 0) / 0.02, 1)
        force = max(2e4 * max(depth, 0) ** 1.5 - 0.8 * share**2 * (3 - 2 * share) * y[1], 0) if depth > 0 else 0
        return [y[1], 1000 * force / 0.5 - 9806.65]

    want = solve_ivp(impact, (0, 0.15), [65.0, 0.0], t_eval=t, rtol=1e-11, atol=1e-11, max_step=1e-4).y
    assert np.abs(column(run, "bodies", "position", "PART_2")[rows][:, 2] * 1e3 - want[0]).max() < 1e-5
    assert np.abs(column(run, "bodies", "velocity", "PART_2")[rows][:, 2] * 1e3 - want[1]).max() < 1e-2
    slide = column(run, "bodies", "velocity", "PART_3")[rows]
    assert np.abs(slide[:, 0] - 1 + 0.1 * (9.80665 * t + slide[:, 2])).max() < 1e-7
    assert np.abs(column(run, "bodies", "position", "PART_3")[rows][:, 2] - 0.13).max() < 0.005
    meeting = t > 0.021
    for part, speed in (("PART_4", 0), ("PART_5", 2)):
        assert np.abs(column(run, "bodies", "velocity", part)[rows][meeting, 0] - speed).max() < 1e-7
    lines = (MODELS / "contacts.adm").read_text().splitlines()
    for words, reason in (("CONTACT/4", "its JGEOM is no sphere, plane or box"), ("CONTACT/1", "the plane across z has no edges in a deck"),
                          ("CONTACT/2", "the face of the box across z has no edges in a deck"), ("CONTACT/2", "POISSON is contact.kelvin_voigt")):
        place = next(k for k, line in enumerate(lines, 1) if line.startswith(words))
        assert any(f"line {place}," in line and reason in line for line in said.splitlines()), (words, reason)


def test_what_is_left_out_is_named_with_its_line(gudgeon):
    _, said = imported(gudgeon, "drives")
    text = (MODELS / "drives.adm").read_text().splitlines()
    for statement in ("JOINT/11", "FRICTION/1", "CONTACT/1", "ARRAY/1", "SFORCE/7", "SFORCE/8", "MOTION/9", "INTEGRATOR"):
        line = next(k for k, words in enumerate(text, 1) if words.startswith(statement))
        assert f"line {line}, column {len(text[line - 1]) - len(text[line - 1].lstrip()) + 1}: {statement}" in said, statement
    for reason in ("IMPACT with a damping that starts abruptly", "function VM is not supported", "is identified by its x axis, along z of the rack; here neither matches", "its law is not supported"):
        assert reason in said, reason


def test_refused_by_name(gudgeon):
    """Elastic bodies are no mechanism of rigid ones; markers and parts that are not there are mistakes with their line."""
    folder = scratch()
    model = (MODELS / "primitives.adm").read_text()
    (folder / "a.adm").write_text(model.replace("JPRIM/8, PARALLEL_AXES, I = 61, J = 5", "NFORCE/8, I = 61, J = 5"))
    done = call(gudgeon, "import", "a.adm", cwd=folder, expect=3)
    assert "NFORCE/8 is an elastic body" in done.stderr
    assert "a.adm:34:" in done.stderr
    (folder / "b.adm").write_text(model.replace("I = 61, J = 5\nACC", "I = 61, J = 999\nACC").replace("ZG", "ZG"))
    done = call(gudgeon, "import", "b.adm", cwd=folder, expect=3)
    assert "J = 999" in done.stderr
    assert not (folder / "b.deck").exists()
    call(gudgeon, "import", MODELS / "pendulum.adm", cwd=folder)
    done = call(gudgeon, "import", MODELS / "pendulum.adm", cwd=folder, expect=9)
    assert "already" in done.stderr
    call(gudgeon, "import", "missing.adm", cwd=folder, expect=9)
    (folder / "empty.adm").write_text("only a title\n")
    assert "no PART" in call(gudgeon, "import", "empty.adm", cwd=folder, expect=3).stderr


@pytest.mark.parametrize("foreign", ["deck = 1\n[scene]\nfl 0.8\n", "t,x\n0,1\nfl 1/2\n", "a title\n\nJUNK/1, FL = 2\n"])
def test_what_is_no_dataset_is_told(gudgeon, foreign):
    """A file without a statement of Adams, though its words begin like one, is named as that, with its first line that is none."""
    folder = scratch()
    (folder / "d.adm").write_text(foreign)
    said = call(gudgeon, "import", "d.adm", cwd=folder, expect=3).stderr
    assert "the file has no statement of an Adams dataset" in said and f"d.adm:{3 if 'JUNK' in foreign else 2}:1" in said, said
    assert "elastic" not in said


def test_words_without_a_slash_are_left_out(gudgeon):
    """`fl 0.8` in a dataset is no FLEX_BODY."""
    folder = scratch()
    (folder / "d.adm").write_text((MODELS / "pendulum.adm").read_text().replace("END\n", "fl 0.8\nEND\n"))
    assert "FL: not supported" in call(gudgeon, "import", "d.adm", cwd=folder).stdout


@pytest.mark.parametrize("line, words", [
    ("MARKER/2, PART = 2, QP = 1, 0, 0", "MARKER/2 is defined twice"),
    ("PART/2, MASS = 3, CM = 2", "PART/2 is defined twice"),
    ("JOI/1, SPHERICAL, I = 2, J = 1", "JOINT/1 is defined twice"),
    ("VARIABLE/7, FUNCTION = 2\nVAR/7, FUNCTION = 3", "VARIABLE/7 is defined twice"),
    ("PART/3, MASS = -1, CM = 3\nMARKER/3, PART = 3", "PART/3 has a negative mass"),
    ("PART/3, MASS = 1, CM = 3, IP = 1, -1, 1\nMARKER/3, PART = 3", "PART/3 has a negative mass or moment of inertia"),
])
def test_statements_there_twice_and_negative_masses(gudgeon, line, words):
    """Which of two markers of one number is meant nobody can say: a mistake with its line, and no deck."""
    folder = scratch()
    text = "d\nUNITS/SYSTEM = MKS\nPART/1, GROUND\nMARKER/1, PART = 1\nPART/2, MASS = 1, CM = 2, IP = 1, 1, 1\nMARKER/2, PART = 2\n"
    (folder / "d.adm").write_text(text + "JOINT/1, REVOLUTE, I = 2, J = 1\n" + line + "\n")
    done = call(gudgeon, "import", "d.adm", cwd=folder, expect=3)
    assert words in done.stderr
    assert f"d.adm:{text.count(chr(10)) + 1 + len(line.splitlines()) - ('negative' in words)}:" in done.stderr
    assert not (folder / "d.deck").exists()


def test_variables_that_name_themselves_end(gudgeon):
    """Neither for ever nor without bounds: what is left has no words, and the variable that has is put in."""
    folder = scratch()
    text = "v\nUNITS/SYSTEM = MKS\nPART/1, GROUND\nMARKER/1, PART = 1\nPART/2, MASS = 1, CM = 2, IP = 1, 1, 1\nMARKER/2, PART = 2\n"
    text += "JOINT/1, TRANSLATIONAL, I = 2, J = 1\nVARIABLE/1, FUNCTION = VARVAL(1) + VARVAL(1) + VARVAL(2)\n"
    text += "VARIABLE/2, FUNCTION = VARVAL(1)*VARVAL(1)*VARVAL(1)\nVARIABLE/3, FUNCTION = TIME\n"
    for k, function in ((1, "VARVAL(1)"), (2, "VARVAL(3)*2 + VARVAL(3)"), (3, "")):
        text += f"SFORCE/{k}, I = 2, J = 1, ACTIONONLY, TRANSLATION, FUNCTION = {function}\n" if function else f"SFORCE/{k}, I = 2, J = 1, FUNCTION\n"
    (folder / "v.adm").write_text(text)
    done = call(gudgeon, "import", "v.adm", cwd=folder, limit=20)
    assert "SFORCE/1: it has more than" in done.stdout and "SFORCE/3: it has no FUNCTION" in done.stdout
    call(gudgeon, "run", "v.deck", "--quiet", cwd=folder)
    run = h5py.File(folder / "outputs" / "v" / "run.h5")
    assert np.abs(column(run, "forces", "force", "SFORCE_2")[:, 2] - 3 * run["time"][:]).max() < 1e-12


def test_datasets_of_nothing_that_moves(gudgeon_debug):
    """No part but the ground, and numbers of markers that no integer has, end with a message."""
    folder = scratch()
    (folder / "g.adm").write_text("g\nPART/1, GROUND\nMARKER/1, PART = 1\nEND\n")
    assert "no bodies" in call(gudgeon_debug, "import", "g.adm", cwd=folder, expect=3).stderr
    (folder / "n.adm").write_text((MODELS / "springs.adm").read_text().replace("VR(31,20)", "VR(1E300,20)"))
    assert "marker 1000000000 of VR is not a MARKER of a rigid part" in call(gudgeon_debug, "import", "n.adm", cwd=folder).stdout


@pytest.mark.parametrize("reuler", ["90D, 90D, 0D", "0D, 90D, 0D", "0D, 90D, 90D"])
def test_axes_that_begin_across_one_another(gudgeon_debug, reuler):
    """A pin whose axes begin at right angles: no angle is undefined, whichever axis x lies along the other's z."""
    folder = scratch()
    text = "p\nUNITS/SYSTEM = MKS\nPART/1, GROUND\nMARKER/1, PART = 1\nPART/2, MASS = 1, CM = 2, IP = 1, 1, 1\nMARKER/2, PART = 2\n"
    (folder / "p.adm").write_text(text + f"MARKER/3, PART = 2, REULER = {reuler}\nJOINT/1, REVOLUTE, I = 3, J = 1\n")
    call(gudgeon_debug, "import", "p.adm", cwd=folder, expect=(0, 4))


@pytest.mark.parametrize("broken", ["SFORCE/1, I = 1, J = 2, FUNCTION = VARVAL( )", "SFORCE/1, I = 1, J = 2, FUNCTION = 1E300*VR(1)", "MOTION/1, JOINT = 1, FUNCTION", "SFORCE/1, I = 2, J = 1, FUNCTION", "GFORCE/1, I = 2, JFLOAT = 1, RM = 1, FX", "PART/2, MASS =", "JOINT/1, REVOLUTE", "MOTION/1, JOINT = 1, FUNCTION = SIN(", "SFORCE/1, I = 1, J = 2, FUNCTION = ((((1"])
def test_broken_statements_end_with_a_message(gudgeon_debug, broken):
    folder = scratch()
    (folder / "a.adm").write_text((MODELS / "pendulum.adm").read_text().replace("END\n", broken + "\nEND\n"))
    call(gudgeon_debug, "import", "a.adm", cwd=folder, expect=(0, 3))


def test_a_force_by_the_square_of_a_length_is_a_spring_of_no_length(gudgeon):
    """It stores least where the length is 0, found to round-off, which is no negative free length; it pulls with -0.5 DM**2."""
    folder = scratch()
    text = "s\nUNITS/SYSTEM = MKS\nPART/1, GROUND\nMARKER/1, PART = 1\nPART/2, MASS = 1, CM = 2, IP = 1, 1, 1, QG = 0.3048, 0, 0\nMARKER/2, PART = 2\n"
    (folder / "s.adm").write_text(text + "SFORCE/1, TRANSLATION, I = 2, J = 1, FUNCTION = -0.5*DM(2,1)**2\nEND\n")
    call(gudgeon, "import", "s.adm", cwd=folder)
    call(gudgeon, "run", "s.deck", "--set", "end=1s", "--tolerance", "1e-11", "--quiet", cwd=folder)
    run = h5py.File(folder / "outputs" / "s" / "run.h5")
    want = solve_ivp(lambda _, y: [y[1], -0.5 * y[0] ** 2], (0, 1), [0.3048, 0.0], t_eval=run["time"][:], rtol=1e-12, atol=1e-13).y[0]
    assert np.abs(column(run, "bodies", "position", "PART_2")[:, 0] - want).max() < 1e-9


def test_degrees_that_look_like_exponents_are_told(gudgeon):
    """`1D-3` in an expression is a degree less 3, `1D3` and `1E-3` are numbers: the first is on the list, with its line."""
    folder = scratch()
    text = "d\nUNITS/SYSTEM = MKS\nPART/1, GROUND\nMARKER/1, PART = 1\nPART/2, MASS = 1D-3, CM = 2, IP = 1, 1, 1\nMARKER/2, PART = 2\n"
    (folder / "d.adm").write_text(text + "SFORCE/1, I = 2, J = 1, ACTIONONLY, TRANSLATION, FUNCTION = 1d-3*TIME + 1D3 + 1E-3 + 30D\n")
    said = call(gudgeon, "import", "d.adm", cwd=folder).stdout
    assert "line 7, column 50: '1d-3' is 1 degrees minus 3; use E for the exponent" in said
    assert said.count("use E for the exponent") == 1
    assert "1e-3" in (folder / "d.deck").read_text().lower()


@pytest.mark.parametrize("line, column, words", [
    ("MARKER/3, PART = 2, QP = 1, 2", 21, "QP has 2 numbers where three are expected"),
    ("MARKER/3, PART = 2\n, QP = 1", 3, "QP has 1 number where three are expected"),
    ("MARKER/3, PART = 2, QP", 21, "QP has 0 numbers where three are expected"),
    ("MARKER/3, PART = 2, REULER = 90D, 0, 0, 0", 21, "REULER has 4 numbers where three are expected"),
    ("MARKER/3, PART = 2, ZP = 0, 1", 21, "ZP has 2 numbers where three are expected"),
    ("MARKER/3, PART = 2, &\n  XP = 0, 1", 3, "XP has 2 numbers where three are expected"),
    ("MARKER/3, PART = 2; PART/3, MASS = 1, QG = 0, 1", 39, "QG has 2 numbers where three are expected"),
    ("PART/3, MASS = 1,\tZG = 1", 19, "ZG has 1 number where three are expected"),
    ("PART/3, MASS = 1, XG = 1, 0", 19, "XG has 2 numbers where three are expected"),
    ("PART/3, MASS = 1, CM = 2, IP = 1, 1", 27, "IP needs three or six numbers"),
    ("MARKER/3, PART = 2, 1", 11, "PART has 2 numbers where one is expected"),
    ("  MARKER/3, PART = 7", 3, "MARKER/3 is on PART/7, which does not exist"),
])
def test_numbers_that_are_not_as_many_as_needed(gudgeon, line, column, words):
    """A vector with two numbers is no vector with a zero: a mistake, and the caret stands under the argument."""
    folder = scratch()
    text = "d\nUNITS/SYSTEM = MKS\nPART/1, GROUND\nMARKER/1, PART = 1\nPART/2, MASS = 1, CM = 2, IP = 1, 1, 1\nMARKER/2, PART = 2\n"
    (folder / "d.adm").write_text(text + line + "\n")
    done = call(gudgeon, "import", "d.adm", cwd=folder, expect=3)
    assert words in done.stderr
    assert f"d.adm:{text.count(chr(10)) + len(line.splitlines())}:{column}" in done.stderr
    assert not (folder / "d.deck").exists()
