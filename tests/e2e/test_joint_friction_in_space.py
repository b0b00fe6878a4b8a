"""Friction in ideal pins and guides of space: against closed forms."""

import numpy as np
import pytest
from support import Run, call, scratch, written

MU, MASS, G = 0.2, 2.0, 9.81

ROTOR = """deck = 1
[scene]
title = "Rotor on a pin"
space = spatial
gravity = 0 0 -9.81 m/s^2
[bodies]
name mass[kg] ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2] SPIN[rad/s]
rotor 2 0.01 0.01 0.01 40
[points]
name body PLACE[mm]
frame ground PLACED
heart rotor PLACED
[joint.revolute]
name i j axis_i friction radius[mm] bearing_length[mm] face_radius[mm] preload[N]
pin frame heart AXIS dry 20 LENGTH 50 PRELOAD
[friction.ambrosio]
name coefficient v0[mm/s] v1[mm/s]
dry 0.2 0.01 0.1
[analysis.dynamic]
start = given
end = 0.2 s
tolerance = 1e-9
INTEGRATOR
[output]
every = 10 ms
channels = rotor.spin pin.friction_moment energy.residual
figures = pin.friction_moment
"""

SLIDER = """deck = 1
[scene]
title = "Slider on an incline"
space = spatial
gravity = 0 0 -9.81 m/s^2
[bodies]
name mass[kg] ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2]
block 2 0.01 0.01 0.01
[points]
name body xi[mm] eta[mm] zeta[mm]
frame ground POINT
foot block POINT
[joint.translational]
name i j axis_i friction slider_length[mm] slider_width[mm]
way frame foot "0.6 0 -0.8" dry LENGTH WIDTH
[friction.ambrosio]
name coefficient v0[mm/s] v1[mm/s]
dry 0.2 0.001 0.01
[analysis.dynamic]
start = given
end = 0.2 s
tolerance = 1e-9
[output]
every = 10 ms
channels = block.position way.friction_force energy.residual
"""


def rotor(gudgeon, axis, spin, place="0", length="0", preload="0", integrator="", column="xi"):
    """A rotor whose pin is beside its centre of mass, along its axis."""
    text = ROTOR
    words = {
        "AXIS": axis,
        "SPIN": spin,
        "PLACED": place,
        "PLACE": column,
        "LENGTH": length,
        "PRELOAD": preload,
        "INTEGRATOR": integrator,
    }
    for word, value in words.items():
        text = text.replace(word, value)
    directory = scratch()
    call(gudgeon, "run", written(directory, text), "--out", directory / "out", "--quiet")
    return Run(directory / "out")


@pytest.mark.parametrize("integrator", ["", "method = ida", "method = bdf"])
def test_a_pin_under_its_weight(gudgeon, integrator):
    """Axis across gravity: N = m g + preload at the radius of the pin."""
    run = rotor(gudgeon, '"1 0 0"', "wx", preload="5", integrator=integrator)
    moment = MU * 20e-3 * (MASS * G + 5)
    np.testing.assert_allclose(run.item("bodies/spin", "rotor")[:, 0], 40 - moment / 0.01 * run.time, atol=2e-6)


def test_a_pin_on_its_face(gudgeon):
    """Axis along gravity: the weight rubs at the radius of the face."""
    run = rotor(gudgeon, '"0 0 1"', "wz")
    np.testing.assert_allclose(run.item("bodies/spin", "rotor")[:, 2], 40 - MU * 50e-3 * MASS * G / 0.01 * run.time, atol=1e-7)


@pytest.mark.parametrize(("place", "length"), [("-30", "100"), ("-80", "100"), ("-80", "0")])
def test_an_overhung_rotor(gudgeon, place, length):
    """The ends of a bearing share the weight, or press against each other: N = max(1, 2 a/L) m g."""
    run = rotor(gudgeon, '"1 0 0"', "wx", place=place, length=length)
    share = 1.0 if length == "0" else max(1.0, 2 * abs(float(place)) / float(length))
    moment = MU * 20e-3 * MASS * G * share
    np.testing.assert_allclose(run.item("bodies/spin", "rotor")[:, 0], 40 - moment / 0.01 * run.time, atol=1e-7)
    assert np.abs(run.read("energy/residual")).max() < 1e-8


@pytest.mark.parametrize(("length", "width"), [(0, 0), (100, 0), (40, 0), (100, 50)])
def test_a_slider_on_an_incline(gudgeon, length, width):
    """The guide lies a = 30 mm below and b = 10 mm beside the centre of mass: N of the ends, and of the sides 2 m g_n b/w.

    The friction force acts at the guide: it gives a moment about the centre of mass which the ends bear too.
    """
    a, b = 30.0, 10.0
    along, across = 0.8 * G, 0.6 * G
    text = SLIDER.replace("POINT", f"{-0.8 * a} {b} {-0.6 * a}").replace("LENGTH", str(length)).replace("WIDTH", str(width))
    directory = scratch()
    call(gudgeon, "run", written(directory, text), "--out", directory / "out", "--quiet")
    run = Run(directory / "out")
    friction = 0.0
    for _ in range(200):  # the force of friction, by iteration
        moment = np.array([-friction * b, friction * a])  # about the axes n and y, at the guide: what the guide bears
        force = np.array([MASS * across, 0.0])
        if length:
            lever = np.array([moment[1], -moment[0]]) / length
            normal = np.linalg.norm(force / 2 + lever) + np.linalg.norm(force / 2 - lever)
        else:
            normal = np.linalg.norm(force)
        if width:
            normal += 2 * MASS * across * b / width
        friction = MU * normal
    way = np.linalg.norm(run.item("bodies/position", "block"), axis=1)
    np.testing.assert_allclose(way[-1], 0.5 * (along - friction / MASS) * run.time[-1] ** 2, rtol=1e-5)
