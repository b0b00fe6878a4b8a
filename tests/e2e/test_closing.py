"""Closed loops of redundant joints with rounded numbers; assemblies that are shaky; drivers at a dead centre."""

import math
import re
import sys

import numpy as np
import pytest
from support import ROOT, Run, assert_close, call, scratch, written

sys.path.insert(0, str(ROOT / "tests" / "stability"))
import random_loops  # noqa: E402

EACH = 6  # loops of a kind, with 3 to 8 digits; `make stability` tries 200


def run(gudgeon, text, *options, expect=0):
    """Run a deck given as text."""
    directory = scratch()
    done = call(gudgeon, "run", written(directory, text), "--out", directory / "out", "--write", "channels", *options, expect=expect)
    return Run(directory / "out", done)


@pytest.mark.parametrize("kind", random_loops.KINDS)
def test_rounded_loops(gudgeon, kind):
    """Assembled with a warning and moved as the exact loop, or refused with the joint and its misfit."""
    for seed in range(EACH):
        mistakes = random_loops.mistakes_of(gudgeon, kind, seed)
        assert not mistakes, f"{kind} {seed}: {'; '.join(mistakes)}"


PAIR = """deck = 1
[scene]
space = spatial
gravity = 0 0 0 m/s^2
[bodies]
name  mass[kg] ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2] x[mm] y[mm] z[mm] axis angle[deg]
in    1  1e-3 1e-3 5e-4   0 0 -100  "0 0 1" 0
out   1  1e-3 1e-3 5e-4   0 50 86.6  "1 0 0" -30
[points]
name body xi[mm] eta[mm] zeta[mm]
G1 ground 0 0 -100
G2 ground 0 50 86.6
i1 in 0 0 0
i2 in 0 0 100
o1 out 0 0 -100
o2 out 0 0 0
[joint.revolute]
name i j axis_i
b1 G1 i1 "0 0 1"
b2 G2 o2 "0 0.5 0.866025"
[joint.universal]
name i j axis_i axis_j
cross i2 o1 "1 0 0" "0 1 0"
[driver.speed]
name joint speed
motor b1 600rpm
[analysis.dynamic]
end = 2 turns of motor
[output]
every = 1 ms
channels = *
"""


def test_universal_pair(gudgeon):
    """86.6 mm and 0.866025: the shafts turn as the formula says, with a warning of the misfit; not where nothing is allowed."""
    result = run(gudgeon, PAIR)
    (warning,) = [w for w in result.summary["warnings"] if "is off by" in w]
    assert re.search(r"is off by 0\.00\d+ mm", warning), warning
    assert "'cross'" in warning
    speed = result.item("bodies/angular_velocity", "out")
    turn = 2 * math.pi * 10 * result.time
    bend = math.radians(30.0)
    # the fork of the driving shaft lies across the plane of both at the start: rate of the driven one
    ratio = math.cos(bend) / (1.0 - math.sin(bend) ** 2 * np.sin(turn) ** 2)
    other = math.cos(bend) / (1.0 - math.sin(bend) ** 2 * np.cos(turn) ** 2)
    rate = np.linalg.norm(speed, axis=1) / (2 * math.pi * 10)
    off = min(np.abs(rate - ratio).max(), np.abs(rate - other).max())
    assert off < 2e-4, off
    tight = run(gudgeon, PAIR.replace("[scene]\n", "[scene]\nclosing_tolerance = 1e-6\n"), expect=4)
    assert re.search(r"is off by [0-9.e-]+ mm and [0-9.e-]+ deg|is off by [0-9.e-]+ mm", tight.done.stderr), tight.done.stderr
    assert "closing_tolerance" in tight.done.stderr


@pytest.mark.parametrize("fault", [0.02, 0.1])
def test_axis_that_is_off(gudgeon, fault):
    """An axis that is off by more than rounding is refused, with degrees of the order of the fault."""
    loop = random_loops.Loop("four_bar", 1)
    done, places = loop.run(gudgeon, 10, scratch(), fault=fault)
    assert places is None
    assert done.returncode == 4
    angles = [float(x) for x in re.findall(r"([0-9.e-]+) deg", done.stderr.split("allowed")[0])]
    assert angles, done.stderr
    assert 0.05 * math.degrees(fault) < max(angles) < 2.0 * math.degrees(fault), done.stderr


TRIANGLE = """deck = 1
[scene]
gravity = 0 -9.81 m/s^2
[bodies]
name mass[kg] inertia[kg.m^2] x[m] y[m] angle[deg]
a 1 1e-3 0.1 0 0
b 1 1e-2 0.4 0 0
[points]
name body xi[m] eta[m]
o ground 0 0
q ground 0.6 0
a0 a -0.1 0
a1 a 0.1 0
b0 b -0.2 0
b1 b 0.2 0
[joint.revolute]
name i j
A o a0
B a1 b0
C b1 q
"""


@pytest.mark.parametrize("analysis", ["[analysis.dynamic]\nend = 1 s\n", "[analysis.static]\n", "[analysis.kinematic]\nend = 1 s\n"])
def test_straight_triangle(gudgeon, analysis):
    """Three joints in a line: named, in every analysis."""
    result = run(gudgeon, TRIANGLE + analysis, expect=4)
    message = result.done.stderr
    assert "infinitesimally mobile (shaky)" in message, message
    assert all(f"'{name}'" in message for name in ("A", "B", "C", "a", "b")), message


def test_triangle_that_is_not_straight(gudgeon):
    """A little off the line it is rigid, and stands."""
    text = TRIANGLE.replace("a 1 1e-3 0.1 0 0", "a 1 1e-3 0.08 0.06 {atan2(0.06,0.08)*1rad}").replace("b 1 1e-2 0.4 0 0", "b 1 1e-2 0.38 0.06 -16")
    text = text.replace("q ground 0.6 0", "q ground 0.55 0").replace("angle[deg]", "angle").replace("0.1 0 0", "0.1 0 0deg").replace("-16", "-16deg")
    result = run(gudgeon, text + "[analysis.dynamic]\nend = 0.1 s\n")
    assert_close(np.ptp(result.item("bodies/position", "a"), axis=0), [0.0, 0.0], absolute=1e-9, what="motion")


FOUR_BAR = """deck = 1
[scene]
gravity = 0 -9.81 m/s^2
[bodies]
name mass[kg] inertia[kg.m^2] x[m] y[m] angle
crank 1 1e-2 0.1 0 0deg
rocker 1 1e-2 0.7 0 0deg
rod 1 1e-2 0.5 0 0deg
[points]
name body xi[m] eta[m]
a ground 0 0
d ground 0.6 0
ca crank -0.1 0
cb crank 0.1 0
ra rod -0.3 0
rb rod 0.3 0
rd rocker -0.1 0
rc rocker 0.1 0
[joint.revolute]
name i j
A a ca
B cb ra
C rc rb
D d rd
"""


@pytest.mark.parametrize("more", ["", "[driver.speed]\nname joint speed\nmotor A 60rpm\n"])
def test_flat_parallelogram_is_not_shaky(gudgeon, more):
    """Branches of the motion meet there: it moves."""
    done = call(gudgeon, "explain", written(scratch(), FOUR_BAR + more + "[analysis.dynamic]\nend = 0.1 s\n"), expect=(0, 4))
    assert "shaky" not in done.stdout + done.stderr


@pytest.mark.parametrize("kind", ["bennett", "four_bar", "spherical", "universal"])
def test_overconstrained_linkages_are_not_shaky(gudgeon, kind):
    """Redundant rows, and a finite motion."""
    loop = random_loops.Loop(kind, 2)
    done, places = loop.run(gudgeon, random_loops.EXACT, scratch())
    assert places is not None, done.stderr
    assert "shaky" not in done.stdout + done.stderr


SLIDER_CRANK = """deck = 1
[parameters]
a0 = 0 deg
[bodies]
name mass[kg] inertia[kg.m^2] x[m] y[m] angle
crank 1 1e-2 {0.05m*cos(a0)} {0.05m*sin(a0)} {a0}
rod 1 1e-2 {0.1m*cos(a0)+0.15m} 0 {0 deg}
slider 1 1e-2 0.4 0 {0deg}
[points]
name body xi[m] eta[m]
a ground 0 0
ca crank -0.05 0
cb crank 0.05 0
ra rod -0.15 0
rb rod 0.15 0
s slider 0 0
[joint.revolute]
name i j
A a ca
B cb ra
C rb s
[joint.translational]
name i j axis
rail a s x
[driver.position]
name i j axis position
push a s x {0.4m - 0.1m/s*t}
[analysis.kinematic]
end = 1.9 s
"""


def test_dead_centre_at_the_start(gudgeon):
    """Not over-driven: a dead centre, with driver, joints and time; exit code 4."""
    message = run(gudgeon, SLIDER_CRANK, expect=4).done.stderr
    assert "dead centre of driver 'push' at t = 0 s" in message, message
    assert "over-driven" not in message
    assert all(f"'{name}'" in message for name in ("A", "B", "C")), message
