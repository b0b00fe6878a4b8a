"""Functions that rise: steps and cams, against the formulas of the handbooks, with their derivatives."""

import h5py
import numpy as np
import pytest
from support import assert_close, call, scratch, written

PI = np.pi


def modified_sine(u):
    """Displacement, velocity and acceleration of the modified sine, for a rise of 1 in 1."""
    a = 1 / (4 + PI)
    ends = lambda u, d: (a * (d + PI * u - np.sin(4 * PI * u) / 4), a * PI * (1 - np.cos(4 * PI * u)),
                         4 * a * PI**2 * np.sin(4 * PI * u))
    w = PI / 3 + 4 * PI * u / 3
    middle = (a * (2 + PI * u - 9 / 4 * np.sin(w)), a * PI * (1 - 3 * np.cos(w)), 4 * a * PI**2 * np.sin(w))
    return [np.where(u < 1 / 8, x, np.where(u < 7 / 8, y, z)) for x, y, z in zip(ends(u, 0), middle, ends(u, 4))]


LAWS = {
    "step3": lambda u: (3 * u**2 - 2 * u**3, 6 * u - 6 * u**2, 6 - 12 * u),
    "step5": lambda u: (10 * u**3 - 15 * u**4 + 6 * u**5, 30 * u**2 - 60 * u**3 + 30 * u**4, 60 * u - 180 * u**2 + 120 * u**3),
    "haversine": lambda u: (np.sin(PI * u / 2) ** 2, PI / 2 * np.sin(PI * u), PI**2 / 2 * np.cos(PI * u)),
    "cycloidal": lambda u: (u - np.sin(2 * PI * u) / 2 / PI, 1 - np.cos(2 * PI * u), 2 * PI * np.sin(2 * PI * u)),
    "poly4567": lambda u: (
        35 * u**4 - 84 * u**5 + 70 * u**6 - 20 * u**7,
        140 * u**3 - 420 * u**4 + 420 * u**5 - 140 * u**6,
        420 * u**2 - 1680 * u**3 + 2100 * u**4 - 840 * u**5,
    ),
    "modified_sine": modified_sine,
}
LAWS["poly345"] = LAWS["step5"]

FOLLOWER = """deck = 1
[bodies]
name mass[kg] inertia[kg.m^2] x[m] y[m] angle[rad]
ram 1 1 0 START 0
[points]
name body xi[m] eta[m]
o ground 0 0
c ram 0 0
FUNCTIONS
[joint.translational]
name i j axis
guide o c y
[driver.position]
name i j axis position
cam o c y {LIFT}
[analysis.kinematic]
end = 1 s
[output]
every = 1 ms
channels = ram.*
"""


def follower(program, lift, functions="", start=0.0):
    """Time, position, velocity, acceleration of a ram that is driven."""
    directory = scratch()
    text = FOLLOWER.replace("LIFT", lift).replace("FUNCTIONS", functions).replace("START", str(start))
    call(program, "run", written(directory, text), "--out", directory / "o", "--quiet")
    with h5py.File(directory / "o" / "run.h5") as file:
        return [file["time"][:]] + [file[f"bodies/{name}"][:, 0, 1] for name in ("position", "velocity", "acceleration")]


def rise(law, t, begin, end, low, high):
    """A rise by a law of a handbook, still before and after."""
    u = (t - begin) / (end - begin)
    inside = (u >= 0) & (u < 1)
    s = [np.where(inside, x, 0.0) for x in LAWS[law](np.clip(u, 0, 1))]
    s[0] = np.where(u >= 1, 1.0, s[0])
    return [low + (high - low) * s[0], (high - low) / (end - begin) * s[1], (high - low) / (end - begin) ** 2 * s[2]]


@pytest.mark.parametrize("law", LAWS)
def test_steps(gudgeon, law):
    """From 20 mm at 0.2 s to -30 mm at 0.7 s, to round-off; value and derivatives have no jump that the law does not have."""
    t, *motion = follower(gudgeon, f"{law}(t, 0.2 s, 20 mm, 0.7 s, -30 mm)", start=0.02)
    wanted = rise(law, t, 0.2, 0.7, 0.02, -0.03)
    beside = np.min(np.abs(np.subtract.outer(t, [0.2, 0.7])), axis=1) > 1e-9  # there accelerations of step3 and haversine jump
    for got, x, error in zip(motion, wanted, (2e-15, 2e-14, 5e-13)):
        assert_close(got[beside], x[beside], error, what=law)
    assert_close(motion[0], wanted[0], 2e-15)
    if law not in ("step3", "haversine"):
        assert np.abs(np.diff(motion[2])).max() < 0.03 * np.abs(motion[2]).max() + 1e-12
    h = t[1] - t[0]
    smooth = slice(2, -2)
    slope = (motion[0][:-4] - 8 * motion[0][1:-3] + 8 * motion[0][3:-1] - motion[0][4:]) / (12 * h)
    assert_close(slope, motion[1][smooth], 3e-4, what=law)


@pytest.mark.parametrize("law, back", [("cycloidal", "poly345"), ("poly4567", "-"), ("modified_sine", "cycloidal")])
def test_rise_dwell_return(gudgeon, law, back):
    """A cam of 120 degrees up, 60 still, 90 back, 90 still, at three turns a second."""
    cam = f"[function.cam]\nname law lift[mm] rise[deg] dwell[deg] return[deg] return_law period[deg]\n" \
          f"lift {law} 8 120 60 90 {back} 360\n"
    t, *motion = follower(gudgeon, "lift(6*pi*1rad/s*t)", cam)
    turn = np.mod(6 * PI * t, 2 * PI)
    third, rate = 2 * PI / 3, 6 * PI
    up = rise(law, turn, 0.0, third, 0.0, 0.008)
    down = rise(law if back == "-" else back, turn, PI, 1.5 * PI, 0.0, 0.008)
    for got, x, y, factor, error in zip(motion, up, down, (1, rate, rate**2), (1e-15, 5e-14, 5e-12)):
        assert_close(got, factor * (x - y), error, what=law)


def test_known_instants(gudgeon):
    """Where a law begins and ends is an instant of a load; so is where its formula changes."""
    text = FOLLOWER.replace("FUNCTIONS", "").replace("START", "0").replace(
        "[driver.position]\nname i j axis position\ncam o c y {LIFT}",
        "[force.point]\nname point fy\npush c {modified_sine(t, 0.2 s, 0 N, 0.6 s, 3 N)}",
    ).replace("analysis.kinematic", "analysis.dynamic")
    told = call(gudgeon, "explain", written(scratch(), text)).stdout
    assert "push.fy: not smooth at t = 0.2 0.25 0.55 0.6 s" in told


@pytest.mark.parametrize(
    "row, words",
    [
        ("lift cycloidal 8 0 60 90 - 360", "must be positive"),
        ("lift cycloidal 8 200 100 90 - 360", "shorter than the sum of rise, dwell and return"),
        ("lift cycloidal 8 120 60 - - 360", "without a return"),
        ("lift cycloidal 8 120 60ms 90 - 360", "the rise takes"),
        ("lift square 8 120 60 90 - 360", "choices: cycloidal poly345 poly4567 modified_sine"),
    ],
)
def test_mistakes_of_cams(gudgeon, row, words):
    """Each is told with its place."""
    cam = f"[function.cam]\nname law lift[mm] rise[deg] dwell[deg] return[deg] return_law period[deg]\n{row}\n"
    text = FOLLOWER.replace("LIFT", "lift(1rad/s*t)").replace("FUNCTIONS", cam).replace("START", "0")
    done = call(gudgeon, "check", written(scratch(), text), expect=3)
    assert words in done.stderr and "^" in done.stderr, done.stderr


@pytest.mark.parametrize(
    "lift, words",
    [
        ("step(t, 0 s, 0 mm, 1 s, 1 mm)", "step3 and step5"),
        ("step5(t, 0 s, 0 mm)", "five arguments"),
        ("step5(t, 0 s, 0 mm, 1 s, 1 mm, 2)", "too many"),
        ("step5(t, 0 m, 0 mm, 1 s, 1 mm)", "^"),
        ("step5(t, 1 s, 0 mm, 1 s, 1 mm)", "zero width: x0 equals x1"),
        ("step5(t, 0 s, 0 mm, 1 s, 1 N)", "^"),
        ("stepp5(t, 0 s, 0 mm, 1 s, 1 mm)", "did you mean 'step5'"),
    ],
)
def test_mistakes_of_steps(gudgeon, lift, words):
    """Each is told with its place."""
    text = FOLLOWER.replace("LIFT", lift).replace("FUNCTIONS", "").replace("START", "0")
    done = call(gudgeon, "check", written(scratch(), text), expect=3)
    assert words in done.stderr, done.stderr


def test_signatures(gudgeon):
    """`gudgeon help functions` tells how each function is called."""
    told = call(gudgeon, "help", "functions").stdout
    for law in LAWS:
        assert f"{law}(x, x0, h0, x1, h1)" in told
    assert "atan2(y, x)" in told
