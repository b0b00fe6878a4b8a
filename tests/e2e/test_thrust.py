"""A pin held along its axis by two collars between faces: against closed forms."""

import numpy as np
from support import Run, call, plain, scratch, written

THRUST = """deck = 1
[scene]
title = "Collars between faces"
space = spatial
gravity = 0 0 0 m/s^2
[bodies]
name mass[kg] ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2] vx[m/s] vy[m/s] vz[m/s] wx[rad/s] wy[rad/s] wz[rad/s]
pin 0.4 1e-4 1e-4 2e-4 VELOCITY SPIN
[points]
name body
middle ground
core pin
[material]
name young[GPa] poisson
steel 207 0.3
[clearance.thrust]
name bearing journal axis_i length[mm] gap[mm] face_radius[mm] edge_radius[mm] material law friction
collar middle core "1 2 2" 30 0.5 15 2 steel hard FRICTION
[contact.hertz]
name
hard
[friction.coulomb]
name coefficient
dry 0.1
[analysis.dynamic]
start = given
end = 5 ms
tolerance = 1e-11
[output]
every = 0.1 ms
channels = pin.velocity pin.spin collar.force collar.moment collar.normal_force collar.axial_displacement collar.tilt
"""
AXIS = np.array([1.0, 2.0, 2.0]) / 3


def run_of(gudgeon, velocity, spin, friction="none"):
    """A pin that flies along its axis."""
    directory = scratch()
    text = THRUST
    for word, value in (("VELOCITY", velocity), ("SPIN", spin)):
        text = text.replace(word, " ".join(f"{x:.17g}" for x in value))
    text = text.replace("FRICTION", friction)
    if friction == "none":
        text = text.replace("[friction.coulomb]\nname coefficient\ndry 0.1\n", "")
    call(gudgeon, "run", written(directory, text), "--out", directory / "out", "--quiet")
    return Run(directory / "out")


def test_collars_bounce_between_two_faces(gudgeon):
    """Six points at once: onset at gap/v, Hertz's duration with six times the stiffness, back at the same speed to the other face."""
    v, mass, radius = 0.8, 0.4, 2e-3
    run = run_of(gudgeon, v * AXIS, [0, 0, 0])
    compliance = 2 * (1 - 0.3**2) / 207e9
    stiffness = 6 * 4 / 3 / compliance * np.sqrt(radius)
    depth = (5 * mass * v**2 / (4 * stiffness)) ** 0.4
    duration = 2.94327 * depth / v
    first, second = run.contacts[:6], run.contacts[6:12]
    np.testing.assert_allclose(first["time"], 0.5e-3 / v, rtol=1e-12)
    np.testing.assert_allclose(first["duration"], duration, rtol=1e-5)
    np.testing.assert_allclose(first["peak_force"], stiffness * depth**1.5 / 6, rtol=1e-6)
    np.testing.assert_allclose(second["time"], 0.5e-3 / v + duration + 1e-3 / v, rtol=1e-5)
    assert sorted(plain(name).strip() for name in first["contact"]) == [f"a_{k}" for k in range(1, 7)]
    assert sorted(plain(name).strip() for name in second["contact"]) == [f"b_{k}" for k in range(1, 7)]


def test_friction_of_a_collar_slows_the_spin(gudgeon):
    """A pin that spins fast: friction takes mu radius of the impulse 2 m v from the spin about the axis."""
    v, mass, spin, inertia = 0.8, 0.4, 500.0, 2e-4
    isotropic = THRUST.replace("1e-4 1e-4 2e-4", "2e-4 2e-4 2e-4")
    directory = scratch()
    text = isotropic.replace("FRICTION", "dry")
    text = text.replace("VELOCITY", " ".join(f"{x:.17g}" for x in v * AXIS))
    text = text.replace("SPIN", " ".join(f"{x:.17g}" for x in spin * AXIS))
    call(gudgeon, "run", written(directory, text), "--out", directory / "out", "--quiet")
    run = Run(directory / "out")
    first = run.contacts[:6]
    k = int(np.searchsorted(run.time, (first["time"] + first["duration"])[0])) + 1
    lost = 0.1 * 15e-3 * 2 * mass * v / inertia
    np.testing.assert_allclose(run.item("bodies/spin", "pin")[k], (spin - lost) * AXIS, rtol=1e-6)
    np.testing.assert_allclose(run.item("bodies/velocity", "pin")[k], -v * AXIS, atol=1e-6)


def test_a_scene_turned_about_the_axis_is_the_same_if_its_first_points_turn(gudgeon):
    """A pin that tumbles between the faces, and the same turned by 25 degrees about the axis: along the axis both are one motion
    where `x_i` turns too, and not where it is left out, as six points are no ring."""
    e = np.cross(AXIS, [0.0, 0.0, 1.0])
    x = e / np.linalg.norm(e)

    def turned(v):
        c, s = np.cos(np.radians(25)), np.sin(np.radians(25))
        return c * v + s * np.cross(AXIS, v) + (1 - c) * AXIS * (AXIS @ v)

    def ways(turn, with_x):
        directory = scratch()
        text = THRUST.replace("1e-4 1e-4 2e-4", "1e-4 1e-4 1e-4")
        for word, value in (("VELOCITY", 0.3 * AXIS), ("SPIN", turn(30.0 * (x + 0.2 * np.cross(AXIS, x))))):
            text = text.replace(word, " ".join(f"{v:.17g}" for v in value))
        text = text.replace(" FRICTION", "").replace(" law friction\n", " law x_i\n" if with_x else " law\n")
        if with_x:
            row = " ".join(f"{v:.17g}" for v in turn(x))
            text = text.replace("steel hard\n", f'steel hard "{row}"\n')
        text = text.replace("[friction.coulomb]\nname coefficient\ndry 0.1\n", "")
        call(gudgeon, "run", written(directory, text), "--out", directory / "out", "--quiet")
        run = Run(directory / "out")
        return run.item("clearances/tilt", "collar"), run.item("clearances/axial_displacement", "collar")

    tilt, way = ways(lambda v: v, True)
    for with_x, is_same in ((True, True), (False, False)):
        found = ways(turned, with_x)
        apart = max(np.abs(found[0] - tilt).max() / tilt.max(), np.abs(found[1] - way).max() / np.abs(way).max())
        assert (apart < 1e-7) == is_same, apart
