"""Gears in space against closed forms: bevel gears under a torque, and a planet on a carrier that is driven, over many turns."""

import numpy as np
from support import Run, call, scratch, written

BEVEL = """deck = 1
[scene]
title = "Bevel gears"
space = spatial
gravity = 0 0 0 m/s^2
[bodies]
name mass[kg] ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2] x[mm] y[mm] z[mm]
first 1 2e-4 2e-4 3e-4 0 0 -30
second 1 5e-4 3e-4 3e-4 20 0 0
[points]
name body xi[mm] eta[mm] zeta[mm]
a ground 0 0 -30
b ground 20 0 0
hub_a first 0 0 0
hub_b second 0 0 0
[joint.revolute]
name i j axis_i
pin_a a hub_a "0 0 1"
pin_b b hub_b "1 0 0"
[joint.gear]
name i j axis_i axis_j radius_i radius_j
mesh hub_a hub_b "0 0 -1" "1 0 0" 20mm 30mm
[force.torque]
name body mz
turn first 0.01N.m
[analysis.dynamic]
end = 3 s
tolerance = 1e-10
[output]
every = 0.1 s
channels = first.angular_velocity second.angular_velocity mesh.*
"""

PLANET = """deck = 1
[scene]
title = "Planet gear"
space = spatial
gravity = 0 0 -9.81 m/s^2
[bodies]
name mass[kg] ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2] x[mm] axis angle[deg]
arm    1   1e-4 1e-3 1e-3 25 "0 0 1" 0
planet 0.5 2e-4 2e-4 3e-4 50 "0 0 1" 20
[points]
name body xi[mm]
sun ground 0
heel arm -25
tip arm 25
hub planet 0
[joint.revolute]
name i j
main sun heel
axle tip hub
[joint.gear]
name i j axis_i axis_j radius_i radius_j
mesh sun hub "0 0 1" "0 0 SENSE" 20mm 30mm
[driver.speed]
name joint speed
motor main 7rad/s
[analysis.KIND]
end = 4 s
[output]
every = 20 ms
channels = planet.angular_velocity planet.orientation mesh.violation
"""


def run_text(program, text, *options):
    """Run a deck."""
    directory = scratch()
    call(program, "run", written(directory, text), "--out", directory / "out", "--quiet", *options)
    return Run(directory / "out")


def test_bevel_gears_under_a_torque(gudgeon):
    """One angular acceleration, M/(I_i + I_j (R_i/R_j)^2), over ten turns, and the couple that drives the second gear."""
    for settings in ([], ["--method", "dop853"], ["--method", "bdf", "--tolerance", "1e-9"], ["--method", "ida", "--tolerance", "1e-9"]):
        run = run_text(gudgeon, BEVEL, *settings)
        rise = 0.01 / (3e-4 + 5e-4 * (2 / 3) ** 2)
        limit = 1e-9 if not settings or settings[1] == "dop853" else 1e-6
        first, second = (run.item("bodies/angular_velocity", name) for name in ("first", "second"))
        np.testing.assert_allclose(first[:, 2], rise * run.time, rtol=limit, atol=limit)
        # both axes point away from where they meet: the first turns the other way about the axis that the gear is given
        np.testing.assert_allclose(second[:, 0], rise * run.time * 2 / 3, rtol=limit, atol=limit)
        moment = run.item("joints/moment", "mesh")
        np.testing.assert_allclose(np.abs(moment[5, 2]), 5e-4 * rise * (2 / 3) ** 2, rtol=1e-6)
        assert rise * 3.0**2 / 2 > 20 * np.pi


def test_planet_on_a_driven_arm(gudgeon):
    """w = W (1 + R_s/R_p), whichever way its axis points, in dynamic and in kinematic analyses."""
    for kind in ("dynamic", "kinematic"):
        for sense in ("1", "-1"):
            run = run_text(gudgeon, PLANET.replace("SENSE", sense).replace("KIND", kind))
            np.testing.assert_allclose(run.item("bodies/angular_velocity", "planet")[:, 2], 7 * (1 + 2 / 3), rtol=1e-8)
            turn = np.deg2rad(20) + 7 * (1 + 2 / 3) * run.time
            found = run.item("bodies/orientation", "planet")
            np.testing.assert_allclose(np.abs(found[:, 0]), np.abs(np.cos(turn / 2)), atol=1e-7)
