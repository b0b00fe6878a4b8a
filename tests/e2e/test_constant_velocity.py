"""joint.constant_velocity: two shafts at an angle, against closed forms, by every way of holding the constraints."""

import math
import subprocess

import numpy as np
import pytest
from support import assert_close, run_with, scratch, written

BEND = 35.0  # degrees
WAYS = [{}, {"stabilise": "partitioning"}, {"stabilise": "baumgarte alpha=5s^-1 beta=5s^-1"}, {"stabilise": "projection"},
        {"coordinates": "full"}, {"method": "ida"}, {"method": "bdf", "tolerance": "1e-11"}, {"solver": "sparse"}, {"solver": "complete"}]

s, c = math.sin(math.radians(BEND)), math.cos(math.radians(BEND))
SHAFTS = f"""deck = 1
[scene]
space = spatial
[bodies]
name     mass[kg]  ixx[kg.m^2]  iyy[kg.m^2]  izz[kg.m^2]  x[m]       y[m]  z[m]            axis     angle[deg]
driving  2         0.018        0.02         0.003        0          0     -0.2            "0 0 1"  0
driven   3         0.048        0.05         0.004        {0.3*s!r}  0     {0.3*c!r}       "0 1 0"  {BEND}
[points]
name     body      zeta[m]
near     driving   -0.1
out      driving   0.2
in       driven    -0.3
far      driven    0.2
[points]
name     body      xi[m]      eta[m] zeta[m]
wall     ground    0          0     -0.3
bearing  ground    {0.5*s!r}  0     {0.5*c!r}
[joint.revolute]
name     i         j
pin      wall      near
[joint.inline]
name     i         j     axis_i
shaft    bearing   far   "{s!r} 0 {c!r}"
[joint.constant_velocity]
name     i         j     axis_i    axis_j
bent     out       in    "0 0 1"   "0 0 1"
[initial.speed]
name     joint     speed[rad/s]
begins   pin       8
[force.torque]
name     body      frame   mz[N.m]
drive    driving   world   {{0.2N.m*sin(5rad/(1s)*t)}}
load     driven    body    -0.05
[analysis.dynamic]
end = 2 s
tolerance = 1e-10
[output]
every = 10 ms
"""


@pytest.mark.parametrize("settings", WAYS, ids=str)
def test_bent_shafts(gudgeon, settings):
    """Both shafts have the same speed at every instant, that of one wheel with both moments of inertia; the joint hands on what drives the
    second one, and bends both shafts across their axes by T tan(bend/2), as the plane that halves the angle has it."""
    run = run_with(gudgeon, SHAFTS, **settings)
    t = run.time
    close = 2e-6
    speed = 8 + (0.04 * (1 - np.cos(5 * t)) - 0.05 * t) / 0.007
    first, second = (run.item("bodies/spin", name) for name in ("driving", "driven"))
    assert_close(first[:, 2], speed, absolute=close, what="driving shaft")
    assert_close(second[:, 2], speed, absolute=close, what="driven shaft")
    assert_close(second[:, :2], 0 * second[:, :2], absolute=close, what="the driven shaft stays where it is")
    assert_close(run.item("joints/bend", "bent"), np.radians(BEND) + 0 * t, absolute=1e-7, what="angle of the shafts")
    turned = 0.004 * (0.2 * np.sin(5 * t) - 0.05) / 0.007 + 0.05
    moment = run.item("joints/moment", "bent")
    assert_close(moment[:, 2], -turned, absolute=1e-4, what="moment about the driving shaft")
    assert_close(moment @ [s, 0, c], -turned, absolute=1e-4, what="moment about the driven shaft")
    assert_close(moment[:, 0], -turned * (1 - c) / s, absolute=1e-4, what="moment across the shafts, in their plane")
    assert_close(moment[:, 1], 0 * t, absolute=1e-4, what="moment out of their plane")


def test_universal_beside(gudgeon):
    """The same shafts with a universal joint do not keep the same speed: what holds above is of the joint, not of the scene."""
    text = SHAFTS.replace("[joint.constant_velocity]", "[joint.universal]").replace('bent     out       in    "0 0 1"   "0 0 1"',
                                                                                  'bent     out       in    "1 0 0"   "0 1 0"')
    run = run_with(gudgeon, text)
    ratio = run.item("bodies/spin", "driven")[:, 2] / run.item("bodies/spin", "driving")[:, 2]
    assert ratio.min() < 0.85 and ratio.max() > 1.15


def test_moving_bend(gudgeon):
    """A shaft whose far end a driver swings: the twist, counted as in the paths of both ends, stays the same."""
    swing = SHAFTS.replace("[joint.inline]\nname     i         j     axis_i\n" + f'shaft    bearing   far   "{s!r} 0 {c!r}"\n',
                           '[driver.position]\nname i j axis_i position\nacross bearing far "0 1 0" {0.2m*sin(3rad/(1s)*t)}\n')
    run = run_with(gudgeon, swing, end="1 s", start="given")
    bend = run.item("joints/bend", "bent")
    assert np.ptp(bend) > 0.05
    rows = np.stack([run.item("bodies/orientation", name) for name in ("driving", "driven")], 1)
    e = rows[:, 0] * [1, -1, -1, -1]
    start = np.array([np.cos(np.radians(BEND) / 2), 0, np.sin(np.radians(BEND) / 2), 0])
    assert_close(np.abs(rows[0, 1] @ start), 1.0, absolute=1e-9, what="where the deck puts the driven shaft")
    twist = e[:, 0] * rows[:, 1, 3] + e[:, 3] * rows[:, 1, 0] + e[:, 1] * rows[:, 1, 2] - e[:, 2] * rows[:, 1, 1]
    assert_close(twist, 0 * twist, absolute=1e-9, what="fourth Euler parameter of one shaft against the other")


def test_opposed(gudgeon):
    """Shafts that point at one another are refused, with what to do."""
    directory = scratch()
    deck = written(directory, SHAFTS.replace('"0 0 1"   "0 0 1"', f'"0 0 1"   "{s!r} 0 {-c!r}"'))
    done = subprocess.run([gudgeon, "check", deck], capture_output=True, text=True)
    assert done.returncode != 0
    assert "joint 'bent' is assembled in the reversed configuration" in done.stderr and "reverse axis_i or axis_j" in done.stderr
