"""A block loose in a guide of rectangular section: against closed forms."""

import numpy as np
from support import Run, call, plain, scratch, written

BLOCK = """deck = 1
[scene]
title = "Block between four surfaces"
space = spatial
gravity = 0 0 0 m/s^2
[bodies]
name mass[kg] ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2] vx[m/s] vy[m/s] vz[m/s]
block 0.4 1e-4 1e-4 1e-4 VELOCITY
[points]
name body
line ground
core block
[material]
name young[GPa] poisson
steel 207 0.3
[clearance.translational]
name guide slider axis_i width_axis width[mm] height[mm] length[mm] gap[mm] corner_radius[mm] material law
rail line core "0 0 1" "1 1 0" 20 12 30 0.5 2 steel hard
[contact.hertz]
name
hard
[analysis.dynamic]
start = given
end = 5 ms
tolerance = 1e-11
[output]
every = 0.1 ms
channels = block.velocity block.spin rail.normal_force rail.force
"""


def test_block_bounces_between_two_surfaces(gudgeon):
    """Four corners at once: onset at gap/v, Hertz's duration with four times the stiffness, the way back at the same speed."""
    v, mass, radius = 0.8, 0.4, 2e-3
    along = np.array([1.0, 1.0, 0.0]) / np.sqrt(2.0)
    directory = scratch()
    text = BLOCK.replace("VELOCITY", " ".join(f"{x:.17g}" for x in v * along))
    call(gudgeon, "run", written(directory, text), "--out", directory / "out", "--quiet")
    run = Run(directory / "out")
    compliance = 2 * (1 - 0.3**2) / 207e9
    stiffness = 4 * 4 / 3 / compliance * np.sqrt(radius)
    depth = (5 * mass * v**2 / (4 * stiffness)) ** 0.4
    duration = 2.94327 * depth / v
    contacts = run.contacts
    first, second = contacts[:4], contacts[4:8]
    np.testing.assert_allclose(first["time"], 0.5e-3 / v, rtol=1e-12)
    np.testing.assert_allclose(first["duration"], duration, rtol=1e-5)
    np.testing.assert_allclose(first["peak_force"], stiffness * depth**1.5 / 4, rtol=1e-6)
    np.testing.assert_allclose(second["time"], 0.5e-3 / v + duration + 1e-3 / v, rtol=1e-5)
    assert sorted(plain(name).strip() for name in first["contact"]) == ["B_x", "C_x", "F_x", "G_x"]
    velocity = run.item("bodies/velocity", "block")
    k = int(np.searchsorted(run.time, first["time"][0] + 2 * duration))
    np.testing.assert_allclose(velocity[k], -v * along, atol=1e-9)
