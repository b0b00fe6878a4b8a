"""clearance.slot against planes, a bearing and closed forms, and what a row may not say."""

import numpy as np
import pytest
from support import ROOT, Run, assert_close, call, scratch
from test_cams import FRICTIONS, STEEL, run


def pin(joint, more="", gravity=0.0, body="0.2 4e-5 5 0 0.4 0.9 30", friction="none"):
    """A round pin in a slot of a body that may move."""
    return f"""
[scene]
gravity = 0 -{gravity} m/s^2
[bodies]
name mass[kg] inertia[kg.m^2] x[mm] y[mm] vx[m/s] vy[m/s] omega[rad/s]
plate 1 2e-3 0 0 0 0 2
bob {body}
[points]
name body xi[mm] eta[mm]
s plate 0 0
p bob 0 0
up plate 0 6
down plate 0 -6
g ground 0 0
{STEEL}
{joint.format(friction=friction)}
[contact.lankarani_nikravesh]
name restitution
hard 0.8
[contact.kelvin_voigt]
name stiffness[N/m] restitution
linear 1e6 1
{FRICTIONS}
{more}"""


SLOT = "name slot pin axis {} width[mm] radius[mm] material law friction\nguide {} 12 5 steel {} {{friction}}\n"


def same_motion(a, b, relative=1e-11):
    """Two runs have one motion."""
    for name in ("position", "velocity", "angular_velocity"):
        expected = b.read(f"bodies/{name}")
        assert_close(a.read(f"bodies/{name}"), expected, absolute=relative * abs(expected).max(), what=name)


@pytest.mark.parametrize("friction", ["none", "slip", "stick"])
def test_straight_slot_is_two_planes(gudgeon, friction):
    """Between its ends a straight slot is a plane on each side: motion and contacts."""
    slot = "[clearance.slot]\n" + SLOT.format("length[mm]", "s p x 80", "hard")
    planes = """[clearance.plane]
name plane ball axis axis_angle[deg] radius[mm] material law friction
above up p y 180 5 steel hard {friction}
below down p y 0 5 steel hard {friction}
"""
    one = run(gudgeon, pin(slot, friction=friction), "25 ms")
    two = run(gudgeon, pin(planes, friction=friction), "25 ms")
    assert len(one.contacts) == len(two.contacts) >= 4
    for name in ("time", "impact_speed", "peak_force", "duration", "impulse"):
        assert_close(one.contacts[name], two.contacts[name], relative=1e-10, absolute=1e-14, what=name)
    same_motion(one, two, relative=1e-9 if friction == "slip" else 1e-11)  # its steep friction law amplifies round-off


@pytest.mark.parametrize("friction", ["none", "slip", "stick"])
def test_slot_without_length_is_a_bearing(gudgeon, friction):
    """A slot whose centreline is a point is a round hole; a law with a stiffness of its own is the same there."""
    slot = "[clearance.slot]\n" + SLOT.format("length[mm]", "s p x 0", "linear")
    hole = """[clearance.revolute]
name bearing journal level bearing_radius[mm] clearance[mm] material law friction
guide s p clearance 6 1 steel linear {friction}
"""
    body = "0.2 4e-5 0.5 0.1 0.4 0.9 30"
    one = run(gudgeon, pin(slot, body=body, friction=friction), "25 ms", start="given")
    two = run(gudgeon, pin(hole, body=body, friction=friction), "25 ms", start="given")
    assert len(one.contacts) == len(two.contacts) >= 4
    same_motion(one, two, relative=1e-9 if friction == "slip" else 1e-11)  # its steep friction law amplifies round-off


@pytest.mark.parametrize("wall", [1, -1])
def test_orbit_in_a_groove(gudgeon, wall):
    """A pin runs around in a closed circular groove of the ground: a circle on the outer wall, in closed form. On the inner one it would
    fly off, and is pressed inwards by a spring instead."""
    groove, play, mass, stiffness, speed, pull = 0.1, 1e-3, 0.2, 1e6, 3.0, 400.0
    pressed = mass * speed**2
    low, high = (0.0, 1e-3)
    for _ in range(200):
        delta = 0.5 * (low + high)
        radius = groove + wall * (play + delta)
        force = pressed / radius if wall > 0 else pull * radius - pressed / radius
        low, high = (delta, high) if force > stiffness * delta else (low, delta)
    more = "" if wall > 0 else f"[force.spring]\nname i j stiffness[N/m] free_length[m]\nback g p {pull} 1e-9\n"
    slot = "[clearance.slot]\n" + SLOT.format("arc_radius[mm] arc[deg]", "g p x 100 360", "linear")
    body = f"{mass} 4e-5 {1e3 * radius:.17g} 0 0 {speed} 0"
    result = run(gudgeon, pin(slot, more, body=body), "0.5 s", tolerance="1e-12", start="given", overlap="preload")
    where = result.item("bodies/position", "bob")
    assert_close(np.hypot(*where.T), radius, absolute=1e-9, what="radius")
    turned = speed / radius * result.time
    assert turned[-1] > 4 * np.pi
    assert_close(where, radius * np.array([np.cos(turned), np.sin(turned)]).T, absolute=1e-7, what="position")
    assert_close(result.read("clearances/contacts/normal_force").ravel()[1:], stiffness * delta, absolute=1e-3, what="force")
    assert abs(result.summary["energy_residual_max"]) < 1e-9


def test_walls_ends_and_curves(gudgeon):
    """A pin hops through an arc, a straight slot, and a groove through points: it stays in, and no energy is made."""
    angle = np.linspace(0, 2 * np.pi, 37)
    lists = ['"' + " ".join(f"{v:.12g}" for v in values) + ' mm"' for values in (50 * np.cos(angle), 30 * np.sin(angle))]
    for columns, cells, start in (
        ("length[mm]", "s p x 40", "20 0"),
        ("arc_radius[mm] arc[deg]", "s p x 40 120", "40 1"),
        ("x y closed", f"s p x {lists[0]} {lists[1]} on", "50 0"),
        ("x y", f"s p x {lists[0].replace(' 50 mm', ' mm')} {lists[1].rsplit(' ', 2)[0]} mm\"", "50 1"),
    ):
        for friction in ("none", "slip"):
            text = pin("[clearance.slot]\n" + SLOT.format(columns, cells, "hard"), body=f"0.2 4e-5 {start} 0.5 0.8 40", friction=friction)
            result = run(gudgeon, text, "0.3 s")
            assert len(result.contacts) > 10
            assert result.contacts["peak_penetration"].max() < 1e-4
            assert abs(result.summary["energy_residual_max"]) < 1e-8 * result.summary["energy_max"]


@pytest.mark.parametrize(
    ("columns", "cells", "what"),
    [
        ("width[mm]", "12", "slot 'guide' has no centreline"),
        ("length[mm] arc_radius[mm] arc[deg] width[mm]", "40 10 90 12", "is given twice"),
        ("arc_radius[mm] width[mm]", "40 12", "an arc has a radius and an angle"),
        ("length[mm] arc[deg] width[mm]", "40 90 12", "an arc has a radius and an angle"),
        ("length[mm] closed width[mm]", "40 on 12", "only a groove through points"),
        ("length[mm] width[mm]", "40 10", "a pin is thinner than its slot"),
        ("arc_radius[mm] arc[deg] width[mm]", "5 90 12", "half the width must be less"),
        ("x width[mm]", '"0 1 2 3 mm" 12', "the points have one coordinate"),
    ],
)
def test_mistakes(gudgeon, columns, cells, what):
    """Rows that cannot be, named with line and column."""
    table = f"[clearance.slot]\nname slot pin axis {columns} radius[mm] material law\nguide s p x {cells} 5 steel hard\n"
    done = run(gudgeon, pin(table), "1 ms", expect=3)
    assert what in done.stderr, done.stderr
    assert "scene.deck:" in done.stderr and "^" in done.stderr


def test_yoke_goes_with_its_crank_within_its_play(gudgeon):
    """The yoke of the deck is where the crank's sine is, but for the play and what the walls yield; both walls are met."""
    directory = scratch()
    call(gudgeon, "run", ROOT / "inputs/scotch_yoke.deck", "--out", directory / "out", "--quiet", "--write", "channels")
    result = Run(directory / "out")
    lag = result.item("bodies/position", "yoke")[:, 0] - 0.04 * np.cos(10 * np.pi * result.time)
    deepest = result.contacts["peak_penetration"].max()
    assert deepest < 2e-5
    assert abs(lag).max() < 1e-4 + deepest
    assert lag.max() > 9.9e-5 and lag.min() < -9.9e-5
