"""Friction of joints whose reactions are not unique: a warning names them and what to do; where friction does not depend on these, none."""

import pytest
from support import call, scratch, written

LAW = "[friction.ambrosio]\nname coefficient v0[m/s] v1[m/s]\nmu 0.2 1e-4 1e-3\n"
FLAP = """deck = 1
[scene]
space = spatial
gravity = 0 0 -9.81 m/s^2
[bodies]
name mass[kg] ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2] x[m] y[m] z[m]
flap 2 0.1 0.1 0.1 0.3 0 0
[points]
name body xi[m] eta[m] zeta[m]
w1 ground 0 -0.002 0
w2 ground 0 0.04 0
f1 flap -0.3 -0.002 0
f2 flap -0.3 0.04 0
""" + LAW + "{joints}[{analysis}]\nend = 0.1 s\n{more}[output]\nevery = 10 ms\nchannels = flap.angular_velocity.y\n"
TWO = "[joint.revolute]\nname i j axis_i friction radius[m]\nh1 w1 f1 \"0 1 0\" mu 0.02\nh2 w2 f2 \"0 1 0\" {second} 0.02\n"
# a hinge askew, and a plane across its axis that holds the flap along it a second time
ASKEW = """[joint.revolute]
name i j axis_i friction radius[m] bearing_length[m] face_radius[m]
h1 w1 f1 "0 1 1" mu 0.02 0.05 {face}
[joint.inplane]
name i j axis_i
p w1 f1 "0 1 1"
"""
GUIDES = """deck = 1
[scene]
gravity = 0 -9.81 m/s^2
[bodies]
name mass[kg] inertia[kg.m^2] x[m] y[m] vx[m/s]
b 2 1 0 0 3
[points]
name body xi[m] eta[m]
o ground 0 0
q ground 0 0.2
p b 0 0
r b 0 0.2
""" + LAW + """[joint.translational]
name i j axis friction
one o p x {one}
two q r x -
[analysis.dynamic]
end = 0.1 s
"""
FOUR_BAR = """deck = 1
[scene]
space = spatial
gravity = 0 0 -9.81 m/s^2
[bodies]
name mass[kg] ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2] x[m] y[m] z[m]
crank 1 0.01 0.01 0.01 0.1 0 0
coupler 1 0.01 0.01 0.01 0.4 0.15 0
rocker 1 0.01 0.01 0.01 0.6 0.15 0
[points]
name body xi[m] eta[m] zeta[m]
o1 ground 0 0 0
o2 ground 0.6 0 0
c1 crank -0.1 0 0
c2 crank 0.1 0 0
k1 coupler -0.2 -0.15 0
k2 coupler 0.2 0.15 0
r1 rocker 0 0.15 0
r2 rocker 0 -0.15 0
""" + LAW + """[joint.revolute]
name i j axis_i friction radius[m] bearing_length[m]
A o1 c1 "0 0 1" mu 0.01 {length}
B c2 k1 "0 0 1" - 0 0
C k2 r1 "0 0 1" - 0 0
D r2 o2 "0 0 1" - 0 0
[analysis.dynamic]
end = 0.05 s
"""


def words_of(gudgeon, text, verb="run"):
    """Warnings of a run, or what explain prints, without the breaks of lines."""
    directory = scratch()
    options = ["--out", directory / "out", "--write", "numbers"] if verb == "run" else []
    done = call(gudgeon, verb, written(directory, text), *options)
    return " ".join((done.stdout + done.stderr).split())


def flap(joints, analysis="analysis.dynamic", more=""):
    return FLAP.replace("{joints}", joints).replace("{analysis}", analysis).replace("{more}", more)


@pytest.mark.parametrize("verb", ["run", "explain"])
def test_two_hinges(gudgeon, verb):
    """How two hinges share the weight is not determined, and one rubs: both are named, and the one that rubs by itself."""
    words = words_of(gudgeon, flap(TWO.replace("{second}", "-")), verb)
    assert "the reactions of 'h1' 'h2' are not unique: the minimum-norm reactions are used" in words
    assert "and the motion depends on them through friction in 'h1';" in words
    assert "compliance" in words and "fewer rows" in words
    assert "accelerations are exact" not in words
    assert "through friction in 'h1' 'h2';" in words_of(gudgeon, flap(TWO.replace("{second}", "mu")), verb)


@pytest.mark.parametrize("method", ["verner", "bdf", "radau"])
def test_other_methods(gudgeon, method):
    """Whatever the method."""
    assert "through friction in 'h1';" in words_of(gudgeon, flap(TWO.replace("{second}", "-"), more=f"method = {method}\n"))


def test_the_load_is_shared_by_least_norm(gudgeon):
    """Friction that no redundant row enters changes nothing: without friction there is the plain warning."""
    words = words_of(gudgeon, flap(TWO.replace(" mu ", " - ").replace("{second}", "-")))
    assert "accelerations are exact, but the reactions of 'h1' 'h2' are not unique" in words
    assert "friction" not in words.split("redundant constraints:")[1]


def test_axial_force_alone_is_shared(gudgeon):
    """The axial force of a pin askew is shared with a plane, its radial force and moment are not: only faces that rub depend on it."""
    words = words_of(gudgeon, flap(ASKEW.replace("{face}", "0")))
    assert "accelerations are exact" in words and "through friction" not in words
    assert "depends on them through friction in 'h1';" in words_of(gudgeon, flap(ASKEW.replace("{face}", "0.03")))


def test_planar_guides(gudgeon):
    """Two parallel guides of one block."""
    assert "depends on them through friction in 'one';" in words_of(gudgeon, GUIDES.replace("{one}", "mu"))
    assert "through friction" not in words_of(gudgeon, GUIDES.replace("{one}", "-"))


def test_four_bar_of_pins_in_space(gudgeon):
    """Redundant are moments across the axes and forces along them: friction by the radial force is unique, by the moment it is not."""
    words = words_of(gudgeon, FOUR_BAR.replace("{length}", "0"))
    assert "redundant constraints: 3" in words and "accelerations are exact" in words
    assert "depends on them through friction in 'A';" in words_of(gudgeon, FOUR_BAR.replace("{length}", "0.02"))


def test_one_hinge_has_no_warning(gudgeon):
    """Nothing is redundant."""
    words = words_of(gudgeon, flap(TWO.splitlines(keepends=True)[0] + "".join(TWO.splitlines(keepends=True)[1:3])))
    assert "redundant constraints" not in words and "through friction" not in words
