"""joint.gear and joint.rack against closed forms, by every way of holding the constraints."""

import numpy as np
import pytest
from support import ROOT, assert_close, run_with

WAYS = [{}, {"stabilise": "partitioning"}, {"stabilise": "baumgarte alpha=5s^-1 beta=5s^-1"}, {"coordinates": "full"}, {"method": "ida"},
        {"method": "bdf", "tolerance": "1e-11"}, {"solver": "sparse"}, {"solver": "complete"}]

RACK = """deck = 1
[scene]
gravity = 0 -9.81 m/s^2
[bodies]
name     mass[kg]  inertia[kg.m^2]  x[m]   y[m]   angle[deg]
rack     3         0.1              0      0.2    90
pinion   2         0.004            {side} 0.5    0
[points]
name     body     xi[m]  eta[m]
rail     ground   0      0
foot     rack     -0.2   0
line     rack     0.1    0
axle     ground   {side} 0.5
middle   pinion   0      0
[joint.translational]
name     i     j     axis
guide    rail  foot  y
[joint.revolute]
name     i     j
bearing  axle  middle
[joint.rack]
name     i     j       axis  radius[m]
teeth    line  middle  x     {radius}
[analysis.dynamic]
end = 1 s
start = given
tolerance = 1e-10
[output]
every = 10 ms
"""


@pytest.mark.parametrize("settings", WAYS, ids=str)
def test_planetary_gear(gudgeon, settings):
    """From rest: all speeds are those of rolling without slip, the sun's acceleration and both tooth forces those of the power balance."""
    run = run_with(gudgeon, (ROOT / "inputs/planetary_gear.deck").read_text(), **settings)
    r_sun, r_planet, r_ring, arm = 0.03, 0.02, 0.07, 0.05
    torque, load = 2.0, 5.0
    ratio = r_sun / (r_sun + r_ring)
    spin = 1 - r_ring / r_planet
    inertia = 2.0e-4 + ratio**2 * (5.0e-4 + 0.3 * arm**2 + spin**2 * 6.0e-5)
    acceleration = (torque - ratio * load) / inertia
    close = 2e-6
    time = run.time
    sun = run.item("bodies/angle", "sun")
    assert_close(sun, acceleration * time**2 / 2, absolute=close * abs(sun).max(), what="sun")
    assert sun.max() > 2 * np.pi  # the line of centres passes pi, and Phi is taken next to zero there
    for name, part in (("carrier", ratio), ("planet", spin * ratio)):
        assert_close(run.item("bodies/angle", name), part * sun, absolute=close * abs(sun).max(), what=name)
    # on the sun: torque - R_s F = I_s angle''; on the planet, about its centre: R_p (F_sun - F_ring) = -I_p planet''
    at_sun = (torque - 2.0e-4 * acceleration) / r_sun
    at_ring = at_sun + 6.0e-5 * spin * ratio * acceleration / r_planet
    for name, force in (("inner", at_sun), ("outer", at_ring)):
        found = np.hypot(*run.item("joints/force", name).T)
        assert_close(found, force + 0 * found, absolute=1e-4 * force, what=f"tooth force {name}")
        moment = run.item("joints/moment", name)
        assert_close(moment, 0 * moment, absolute=1e-6 * force * r_sun, what=f"moment about the point of contact, {name}")


@pytest.mark.parametrize("settings", WAYS, ids=str)
@pytest.mark.parametrize("side", [-1, 1])
def test_rack_and_pinion(gudgeon, settings, side):
    """A rack falls and turns a pinion on its right or its left: a = m g/(m + I/R^2), and the teeth carry I a/R^2."""
    radius = 0.08
    text = RACK.format(side=-side * radius, radius=side * radius)  # the axis points up: what is on its left has x < 0
    run = run_with(gudgeon, text, **settings)
    fall = 3 * 9.81 / (3 + 0.004 / radius**2)
    time = run.time
    height = run.item("bodies/position", "rack")[:, 1]
    assert_close(height, 0.2 - fall * time**2 / 2, absolute=1e-7 * fall, what="height of the rack")
    assert_close(run.item("bodies/angle", "pinion"), -side * fall * time**2 / 2 / radius, absolute=1e-6 * fall / radius, what="pinion")
    force = run.item("joints/force", "teeth")
    assert_close(force[:, 1], 0.004 * fall / radius**2 + 0 * time, absolute=1e-5 * fall, what="force on the rack")
    assert_close(force[:, 0], 0 * time, absolute=1e-5 * fall, what="no force across")
