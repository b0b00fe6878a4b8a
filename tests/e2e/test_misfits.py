"""Gears whose radii do not fit where their axes are, and torsion springs whose axes part: named, as their equations hold all the same."""

import subprocess

import pytest
from support import Run, call, scratch, written

PLANE = """deck = 1
[scene]
gravity = 0 0 m/s^2
[bodies]
name mass[kg] inertia[kg.m^2] x[mm] y[mm]
first 1 1e-3 0 0
second 1 1e-3 {x} {y}
[points]
name body xi[m] eta[m]
a ground 0 0
hub_a first 0 0
hub_b second 0 0
[joint.revolute]
name i j
pin_a a hub_a
"""
SPACE = """deck = 1
[scene]
space = spatial
gravity = 0 0 0 m/s^2
[bodies]
name mass[kg] ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2] x[mm] y[mm] z[mm] wx[rad/s] wy[rad/s]
first 1 1e-3 1e-3 1e-3 0 0 0 - -
second 1 1e-3 1e-3 1e-3 {x} {y} {z} {wx} {wy}
[points]
name body
a ground
hub_a first
hub_b second
[joint.revolute]
name i j axis_i
pin_a a hub_a "0 0 1"
"""
END = """
[analysis.dynamic]
end = {end} ms
start = given
[output]
every = 1 ms
channels = energy.residual
"""
MESH = "[joint.gear]\nname i j radius_i[mm] radius_j[mm]\nmesh hub_a hub_b {i} {j}\n"
SPATIAL_MESH = '[joint.gear]\nname i j axis_i axis_j radius_i[mm] radius_j[mm]\nmesh hub_a hub_b "0 0 1" "{axis}" {i} {j}\n'
LINE = "[joint.rack]\nname i j axis radius[mm]\nteeth hub_a hub_b x {radius}\n"
SPATIAL_LINE = '[joint.rack]\nname i j axis_i axis_j radius[mm]\nteeth hub_a hub_b "1 0 0" "0 0 1" {radius}\n'


def plane(part, x=80, y=0, **values):
    """A planar deck."""
    return PLANE.format(x=x, y=y) + part.format(**values) + END.format(end=5)


def space(part, x=80, y=0, z=0, wx="-", wy="-", end=5, **values):
    """A spatial deck."""
    return SPACE.format(x=x, y=y, z=z, wx=wx, wy=wy) + part.format(**values) + END.format(end=end)


def warnings_of(gudgeon, text):
    """What a run warns of."""
    directory = scratch()
    call(gudgeon, "run", written(directory, text), "--out", directory / "out", "--quiet", "--write", "channels")
    return Run(directory / "out").summary["warnings"]


@pytest.mark.parametrize("text", [
    plane(MESH, i=50, j=30), plane(MESH, i=120, j=-40), plane(MESH, x=0, i=50, j=30),
    plane(LINE, x=10, y=40, radius=40), plane(LINE, x=10, y=-40, radius=-40),
    space(SPATIAL_MESH, axis="0 0 1", i=50, j=30, z=7), space(SPATIAL_MESH, axis="0 0 -1", i=50, j=30),
    space(SPATIAL_MESH, axis="0 0 -1", i=-40, j=120), space(SPATIAL_MESH, axis="0 -1 0", i=50, j=30, x=0, y=-30),
    space(SPATIAL_LINE, x=10, y=40, radius=40), space(SPATIAL_LINE, x=10, y=-40, radius=-40),
])
def test_gears_that_fit(gudgeon, text):
    """Nothing is said of them."""
    assert warnings_of(gudgeon, text) == []


@pytest.mark.parametrize("text, words", [
    (plane(MESH, i=50, j=31), ["joint 'mesh'", "an axis distance of 0.081 m", "the distance is 0.08 m"]),
    (plane(MESH, i=50, j=-30), ["joint 'mesh'", "an axis distance of 0.02 m", "the distance is 0.08 m"]),
    (plane(LINE, x=10, y=41, radius=40), ["joint 'teeth'", "radius 0.04 m", "0.041 m to the left"]),
    (plane(LINE, x=10, y=40, radius=-40), ["joint 'teeth'", "radius -0.04 m", "0.04 m to the left"]),
    (space(SPATIAL_MESH, axis="0 0 -1", i=50, j=31), ["joint 'mesh'", "an axis distance of 0.081 m", "the distance is 0.08 m"]),
    (space(SPATIAL_MESH, axis="0 1 0", i=50, j=30), ["joint 'mesh'", "has skew axes", "0.08 m"]),
    (space(SPATIAL_LINE, x=10, y=-40, radius=40), ["joint 'teeth'", "radius 0.04 m", "-0.04 m to the left"]),
])
def test_gears_that_do_not_fit(gudgeon, text, words):
    """Each is named with what its radii ask for and what is there."""
    found = warnings_of(gudgeon, text)
    assert len(found) == 1 and all(word in found[0] for word in words), found


@pytest.mark.parametrize("text, code, words", [
    (plane(MESH, i=0, j=30), 3, ["scene.deck:", "radius_i", "must not be 0"]),
    (space(SPATIAL_MESH, axis="0 0 1", i=50, j=0), 3, ["scene.deck:", "radius_j", "must not be 0"]),
    (plane(LINE, x=10, y=40, radius=0), 3, ["scene.deck:", "must not be 0"]),
    (space(SPATIAL_LINE, x=10, y=40, radius=0), 3, ["scene.deck:", "must not be 0"]),
    (plane(MESH, i=-50, j=-30), 4, ["joint 'mesh'", "two negative radii"]),
    (space(SPATIAL_MESH, axis="0 0 -1", i=-50, j=-30), 4, ["joint 'mesh'", "two negative radii"]),
])
def test_gears_that_cannot_be(gudgeon, text, code, words):
    """No radius is zero, and of two gears one at most is a ring."""
    directory = scratch()
    done = subprocess.run([gudgeon, "run", written(directory, text), "--out", directory / "out"], capture_output=True, text=True)
    assert done.returncode == code and all(word in done.stderr for word in words), done.stderr


SPRING = "[force.torsion_spring]\nname i j axis_i stiffness[N.m/rad]\ncoil ground second \"0 0 1\" 0.1\n"


@pytest.mark.parametrize("spin, words", [("0", []), ("2", ["force element 'coil'", "angle between its axes of 5.73 deg"])])
def test_axes_of_a_torsion_spring_that_part(gudgeon, spin, words):
    """A body that nothing holds turns with 2 rad/s about an axis across that of its spring for 50 ms: 0.1 rad."""
    found = warnings_of(gudgeon, space(SPRING, wx=spin, wy="0", end=50))
    assert len(found) == (1 if words else 0) and all(word in found[0] for word in words), found
