"""Decks of space in which directions, lengths or velocities are as bad as they can be: a message that says so, or the motion."""

import numpy as np
import pytest
from support import Run, call, scratch, written

DECK = """deck = 1
[scene]
title = "degenerate"
space = spatial
gravity = 0 0 -9.81 m/s^2
[bodies]
name mass[kg] ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2] x[m] {columns}
bar  1        0.1         0.2         0.15        0.5  {cells}
[points]
name  body    xi[m]
wall  ground  0
near  bar     -0.5
far   bar     0.5
{tables}
[analysis.dynamic]
end = 0.2 s
energy_limit = 1e-3
[output]
every = 50 ms
"""
PIN = '[joint.revolute]\nname i j axis_i\npin wall near "0 1 0"\n'


def run(program, tables, columns="", cells="", expect=0):
    """Run a deck; its messages, and what is left of it."""
    directory = scratch()
    deck = written(directory, DECK.format(tables=tables, columns=columns, cells=cells))
    done = call(program, "run", deck, "--out", directory / "out", expect=expect)
    return done, Run(directory / "out") if expect == 0 else None


@pytest.mark.parametrize("tables, words", [
    ('[joint.universal]\nname i j axis_i axis_j\npin wall near "0 0 1" "0 0 1"\n', "perpendicular but must be parallel, or vice versa"),
    ('[joint.revolute]\nname i j axis_i axis_j\npin wall near "0 0 1" "1 0 0"\n', "perpendicular but must be parallel, or vice versa"),
    ('[joint.perpendicular]\nname i j axis_i axis_j\npin wall near "0 0 1" "0 0 1"\n', "perpendicular but must be parallel, or vice versa"),
    ('[joint.revolute_spherical]\nname i j axis_i\npin wall far "1 0 0"\n', "joint 'pin' has a residual of 0.5 m"),
    ("[joint.distance]\nname i j\npin wall near\n", "the two points coincide initially"),
    (PIN + '[force.torsion_spring]\nname i j axis_i axis_j stiffness[N.m/rad]\ncoil ground bar "0 1 0" "1 0 0" 5\n', "the axes of 'coil' are not parallel"),
    (PIN + '[force.torsion_spring]\nname i j axis_i axis_j stiffness[N.m/rad]\ncoil ground bar "0 1 0" "0 -1 0" 5\n', "the axes of 'coil' are not parallel"),
    ('[joint.revolute]\nname i j axis_i\npin wall near "0 0 0"\n', "all numbers are zero"),
    ('[joint.revolute]\nname i j axis_i x_i\npin wall near "0 1 0" "0 -2 0"\n', "the reference direction of 'pin' is parallel to its axis"),
    (PIN + '[force.torsion_spring]\nname i j axis_i x_j stiffness[N.m/rad]\ncoil ground bar "0 1 0" "0 1 0" 5\n', "the reference direction of 'coil' is parallel to its axis"),
])
def test_told(gudgeon_debug, tables, words):
    """What cannot be put together is told by name."""
    done, _ = run(gudgeon_debug, tables, expect=(3, 4))
    assert words in done.stderr


@pytest.mark.parametrize("size", ["1e-200", "1e200"])
def test_length_of_directions(gudgeon_debug, size):
    """A direction may have any length."""
    _, other = run(gudgeon_debug, PIN.replace('"0 1 0"', f'"0 {size} 0"'))
    _, plain = run(gudgeon_debug, PIN)
    assert np.array_equal(other.read("bodies/position"), plain.read("bodies/position"))


def test_held_body_with_a_velocity(gudgeon_debug):
    """A body that is held altogether stays where it is, whatever velocity the deck gives it; its ledger is round-off and closes."""
    done, found = run(gudgeon_debug, "[joint.rigid]\nname i j\ntie wall near\n", "vx[m/s] wy[rad/s] e0 e1 e2 e3", "1.3 0.7 0.3 0.5 0.1 0.2")
    assert "was changed by 1.3 m/s" in done.stdout + done.stderr and "ledger" not in done.stdout
    assert np.max(np.abs(found.read("bodies/velocity"))) < 1e-15
    assert found.item("joints/force", "tie")[:, 2] == pytest.approx(-9.81 * np.ones(len(found.time)), abs=1e-12)


def test_spring_through_its_own_end(gudgeon_debug):
    """A spring whose points coincide at the start, on a slider: it pulls nowhere there, and the energy is kept."""
    _, found = run(gudgeon_debug, '[joint.translational]\nname i j axis_i\nguide wall near "0 0 1"\n'
                   "[force.spring]\nname i j stiffness[N/m] damping[N.s/m] free_length[m]\ncoil wall near 100 5 0.2\n")
    assert np.all(np.isfinite(found.read("forces/force")))
    assert found.summary["energy_residual_max"] < 1e-5 * found.summary["energy_max"]


SHAFTS = """deck = 1
[scene]
space = spatial
[bodies]
name mass[kg] ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2] x[m]
one  1        0.1         0.2         0.15        0.5
two  1        0.1         0.2         0.15        1.5
[points]
name  body    xi[m]
wall  ground  0
near  one     -0.5
far   one     0.5
here  two     -0.5
there two     0.5
end   ground  {end}
[joint.revolute]
name i j axis_i
bearing wall near "1 0 0"
[joint.universal]
name i j axis_i axis_j
hook far here "{arm_i}" "{arm_j}"
{outlet}
[analysis.dynamic]
end = 0.2 s
"""


@pytest.mark.parametrize("arm_i, arm_j, end, outlet", [
    ("0 0 1", "0.01 0 1", 2, '[joint.cylindrical]\nname i j axis_i\noutlet end there "1 0 0"'),
    ("1 0 0", "1 1e-4 0", 2, '[joint.cylindrical]\nname i j axis_i\noutlet end there "1 0 0"'),
    ("0 0 1", "0 0 1", 2, "[joint.distance]\nname i j length[m]\noutlet end there 2.1"),
    ("0 0 1", "0 0 1", 1.9, "[joint.spherical]\nname i j\noutlet end there"),
])
def test_parallel_arms_are_told_of_the_joint_that_has_them(gudgeon, arm_i, arm_j, end, outlet):
    """The search for a position tears the bearing, or the outlet, far off; to blame is the universal joint between them."""
    deck = written(scratch(), SHAFTS.format(arm_i=arm_i, arm_j=arm_j, end=end, outlet=outlet))
    said = call(gudgeon, "check", deck, expect=4).stderr
    assert "joint 'hook' has, at the given positions of the bodies, a residual of 1 rad" in said
    assert "perpendicular but must be parallel, or vice versa" in said
