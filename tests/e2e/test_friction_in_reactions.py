"""Reactions of ideal joints that rub: constraint forces and friction together hold and accelerate each body, in every analysis and way of solving."""

import numpy as np
import pytest
from support import Run, assert_close, call, scratch, written

G = 9.81
RUB = "[friction.threlfall]\nname coefficient v_r[m/s] above\nrub 0.1 1e-2 exponential\n[friction.lugre]\nname coefficient static_coefficient " \
      "bristle_stiffness[m^-1]\nbristles 0.1 0.15 1e4\n"
BLOCK = """deck = 1
[scene]
gravity = 0 -9.81 m/s^2
[bodies]
name mass[kg] inertia[kg.m^2] x[m] y[m] vx[m/s]
b 2 1 0 0 3
[points]
name body xi[m] eta[m]
o ground 0 0
p b 0 0
[joint.translational]
name i j axis friction
j o p x f
[friction.rooney_deravi]
name coefficient v1[m/s]
f 0.25 0.01
[request.reaction]
name joint on
r j j
[analysis.dynamic]
end = 0.2 s
tolerance = 1e-10
[output]
every = 0.1 s
channels = *
"""
# a crank on a rubbing pin, a slider on it in a guide askew, a bar on a pin of the slider
PLANE = f"""deck = 1
{RUB}
[scene]
gravity = 0 -{G} m/s^2
[bodies]
name mass[kg] inertia[kg.m^2] x[m] y[m] angle[deg] omega[rad/s]
one 3 0.05 0.4 0 0 6
two 1.5 0.02 0.7 0.1 0 6
three 1 0.01 0.9 0.1 0 -4
[points]
name body xi[m] eta[m]
o ground 0 0
a one -0.4 0
b one 0.2 0.05
c two -0.1 -0.05
d two 0.1 0
e three -0.1 0
m1 one 0 0
m2 two 0 0
m3 three 0 0
[joint.revolute]
name i j friction radius[m] preload[N]
A o a rub 0.05 20
C d e bristles 0.01 5
[joint.translational]
name i j axis axis_angle[deg] friction slider_length[m] preload[N]
B b c x 0 rub 0.6 10
[force.spring]
name i j stiffness[N/m] free_length[m]
s a m2 200 0.6
[request.reaction]
name joint on point
A1 A j m1
B1 B i m1
B2 B j m2
C2 C i m2
C3 C j m3
s2 s j m2
s1 s i m1
"""
SPACE = f"""deck = 1
{RUB}
[scene]
space = spatial
gravity = 0 0 -{G} m/s^2
[bodies]
name mass[kg] ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2] x[m] y[m] z[m] wx[rad/s] wz[rad/s]
one 3 0.05 0.05 0.05 0.4 0 0 0 6
two 1.5 0.02 0.02 0.02 0.7 0.1 0.1 0 6
three 1 0.01 0.01 0.01 0.9 0.1 0.2 5 6
[points]
name body xi[m] eta[m] zeta[m]
o ground 0 0 0
a one -0.4 0 0
b one 0.2 0.05 0.02
c two -0.1 -0.05 -0.08
d two 0.1 0 0.05
e three -0.1 0 -0.05
m1 one 0 0 0
m2 two 0 0 0
m3 three 0 0 0
[joint.revolute]
name i j axis_i friction radius[m] preload[N] bearing_length[m] face_radius[m]
A o a "0 0 1" rub 0.05 20 0.1 0.06
C d e "1 0 0" bristles 0.01 5 0.1 0
[joint.translational]
name i j axis_i friction slider_length[m] slider_width[m] preload[N]
B b c "1 0 0.3" rub 0.6 0.4 10
[request.reaction]
name joint on point
A1 A j m1
B1 B i m1
B2 B j m2
C2 C i m2
C3 C j m3
"""
BODIES = {"one": ("A1", "B1", "s1"), "two": ("B2", "C2", "s2"), "three": ("C3",)}
MASS = {"one": 3.0, "two": 1.5, "three": 1.0}
INERTIA = {"one": 0.05, "two": 0.02, "three": 0.01}
WAYS = [("method", "verner"), ("method", "ida"), ("method", "bdf"), ("method", "radau"), ("solver", "lapack"), ("solver", "sparse"), ("stabilise", "partitioning"),
        ("stabilise", "baumgarte alpha=5s^-1 beta=5s^-1")]


def run(gudgeon, text, *settings, analysis="[analysis.dynamic]\nend = 0.3 s\ntolerance = 1e-9\n", output="[output]\nevery = 20 ms\nchannels = *\n"):
    directory = scratch()
    more = "".join(f"{key} = {value}\n" for key, value in settings)
    done = call(gudgeon, "run", written(directory, text + analysis + more + output), "--out", directory / "out", "--write", "channels", "--quiet")
    return Run(directory / "out", done)


def check_balance(result, dimensions, bodies=BODIES, tolerance=1e-6):
    """Newton's and Euler's equations of every body: all moments of inertia of a body are the same."""
    names = [name for group in bodies.values() for name in group]
    told = [str(name).strip() for name in result.read("reactions/names")]
    down = -G * np.eye(dimensions)[dimensions - 1]
    for body, on_it in bodies.items():
        on_it = [name for name in on_it if name in told]
        force = sum(result.item("reactions/force", name) for name in on_it) + MASS[body] * down
        moment = sum(result.item("reactions/moment", name) for name in on_it)
        assert_close(force, MASS[body] * result.item("bodies/acceleration", body), absolute=tolerance, what=f"force on {body}")
        assert_close(moment, INERTIA[body] * result.item("bodies/angular_acceleration", body), absolute=tolerance, what=f"moment on {body}")
    assert set(told) <= set(names)


def test_block_in_a_guide(gudgeon):
    """m a = -mu m g: the guide's reaction and the request tell it."""
    directory = scratch()
    call(gudgeon, "run", written(directory, BLOCK), "--out", directory / "out", "--quiet", "--write", "channels")
    result = Run(directory / "out")
    friction = 0.25 * 2 * G
    assert_close(result.item("joints/force", "j"), [friction, -2 * G], absolute=1e-9, what="force on the guide")
    assert_close(result.item("reactions/force", "r"), [-friction, 2 * G], absolute=1e-9, what="force on the block")
    assert_close(result.item("bodies/acceleration", "b"), [-friction / 2, 0.0], absolute=1e-9, what="acceleration")


@pytest.mark.parametrize("way", WAYS, ids=lambda way: way[1].split()[0])
def test_balance_in_the_plane(gudgeon, way):
    """Two pins, one with bristles, and a guide between moving bodies."""
    check_balance(run(gudgeon, PLANE, way), 2)


@pytest.mark.parametrize("way", WAYS, ids=lambda way: way[1].split()[0])
def test_balance_in_space(gudgeon, way):
    """The same kinds in space, with friction of moments too."""
    check_balance(run(gudgeon, SPACE, way), 3)


def test_force_channels_agree_with_requests(gudgeon):
    """Channels of the joints tell what acts on the body of i, in the plane and in space."""
    for text in (PLANE, SPACE):
        result = run(gudgeon, text)
        for joint, request in (("A", "A1"), ("B", "B2"), ("C", "C3")):
            assert_close(result.item("joints/force", joint), -result.item("reactions/force", request), absolute=1e-9, what=joint)


def test_moment_about_the_pin_is_friction(gudgeon):
    """A pin transmits no moment about its axis but that of its friction."""
    result = run(gudgeon, PLANE)
    for joint in ("A", "C"):
        moment = result.item("joints/moment", joint).ravel()
        assert abs(moment).max() > 0.1
        assert_close(moment, -result.item("joints/friction_moment", joint).ravel(), absolute=1e-9, what=joint)


def test_kinematic_balance(gudgeon):
    """Inverse dynamics: all of them driven."""
    text = PLANE.replace("[force.spring]", "[driver.angle]\nname joint angle\nd1 A {0.5rad*sin(4rad/s*t)}\nd3 C {-0.4rad*sin(5rad/s*t)}\n"
                         "[driver.position]\nname i j axis position\nd2 b c x {0.1m*sin(6rad/s*t)}\n[force.spring]")
    text = text.replace("s2 s j m2", "d11 d1 j m1\nd21 d2 i m1\nd22 d2 j m2\nd32 d3 i m2\nd33 d3 j m3\ns2 s j m2")
    bodies = {"one": ("A1", "B1", "s1", "d11", "d21"), "two": ("B2", "C2", "s2", "d22", "d32"), "three": ("C3", "d33")}
    result = run(gudgeon, text, analysis="[analysis.kinematic]\nend = 1 s\n")
    check_balance(result, 2, bodies, tolerance=1e-7)
