"""Two parallel shafts and an intermediate one askew between them, with a universal joint at each end: one of 19 rows is redundant.

At the start every acceleration is zero, so that the right-hand sides of the dependent rows are round-off: they contradict nobody.
"""

import numpy as np
import pytest
from support import Run, call, scratch, written

OMEGA = 20.0 * np.pi  # rad/s
DECK = """deck = 1
[scene]
title = "pair of universal joints"
space = spatial
[parameters]
bend = 30 deg
half = 100 mm
[bodies]
name   mass[kg] ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2] x[m]                      y[m]               axis    angle
input  1        1e-3        1e-3        1e-3        -0.05                     0                  "0 0 1" 0deg
middle 1        1e-3        4e-3        4e-3        {half*cos(bend)}          {half*sin(bend)}   "0 0 1" {bend}
output 1        1e-3        1e-3        1e-3        {2*half*cos(bend) + 50mm} {2*half*sin(bend)} "0 0 1" 0deg
[points]
name  body   xi                        eta
left  ground -50mm                     0mm
right ground {2*half*cos(bend) + 50mm} {2*half*sin(bend)}
i1    input  0mm                       0mm
i2    input  50mm                      0mm
m1    middle {-half}                   0mm
m2    middle {half}                    0mm
o1    output -50mm                     0mm
o2    output 0mm                       0mm
[joint.revolute]
name   i     j  axis_i
first  left  i1 "1 0 0"
second right o2 "1 0 0"
[joint.universal]
name i  j  axis_i  axis_j
near i2 m1 "0 1 0" "0 0 1"
far  o1 m2 "0 1 0" "0 0 1"
[driver.speed]
name  joint speed[rpm]
motor first 600
[analysis.dynamic]
end = 1 turns of motor
method = METHOD
solver = SOLVER
stabilise = STABILISE
[output]
every = 0.5 ms
channels = input.spin middle.spin output.spin input.orientation
"""


@pytest.mark.parametrize("bend", [0.0, 1.0, 30.0, 45.0])
@pytest.mark.parametrize("method, solver, stabilise", [
    ("auto", "schur", "projection"), ("verner", "sparse", "baumgarte"), ("radau", "lapack", "projection"), ("bdf", "complete", "partitioning")])
def test_motion(gudgeon, bend, method, solver, stabilise):
    """Hooke: w_middle = w cos(b)/(1 - sin(b)^2 cos(theta)^2), largest at the start, when the arm on the input lies in the plane of the bend."""
    directory = scratch()
    deck = written(directory, DECK.replace("METHOD", method).replace("SOLVER", solver).replace("STABILISE", stabilise))
    call(gudgeon, "run", deck, "--set", f"bend={bend} deg", "--out", directory / "out", "--quiet")
    run = Run(directory / "out")
    time, spin, b = run.time, run.read("bodies/spin"), np.radians(bend)
    expected = OMEGA * np.cos(b) / (1.0 - (np.sin(b) * np.cos(OMEGA * time)) ** 2)
    np.testing.assert_allclose(spin[:, 1, 0], expected, rtol=1e-6)
    np.testing.assert_allclose(spin[:, 2, 0], OMEGA, rtol=1e-6)
