"""Slots with an open end, and the Geneva wheel made of them, against closed forms, rigid impacts and a disc at the corner."""

import numpy as np
import pytest
from scipy.optimize import brentq
from support import ROOT, Run, assert_close, call, changed, plain, scratch, written
from test_cams import STEEL, run

DECK = (ROOT / "inputs/geneva_wheel.deck").read_text()
A, R, SPEED, PLAY = 0.1, 0.1 * np.sqrt(0.5), 2 * np.pi, 5e-5


def deck_run(program, text=DECK, *options):
    """A run of the deck, with changes."""
    directory = scratch()
    call(program, "run", written(directory, changed(text, "output", figures=None)), "--out", directory / "out", "--quiet", "--write", "channels", *options)
    return Run(directory / "out")


def exact(alpha):
    """Closed form of the turned angle of the wheel from the entry, its first and second derivative by the angle of the crank."""
    ratio = R / A
    below = 1 - 2 * ratio * np.cos(alpha) + ratio**2
    beta = np.arctan2(np.sin(alpha), A / R - np.cos(alpha))
    slope = ratio * (np.cos(alpha) - ratio) / below
    second = -ratio * (1 - ratio**2) * np.sin(alpha) / below**2
    return -(beta + np.pi / 4), -slope, -second


def test_wheel_follows_the_closed_form(gudgeon):
    """In a slot the pin is within its clearance of the centreline; where it lies on a wall the rate and the force are those of the
    closed form; outside the wheel stands within the clearance of its lock."""
    result = deck_run(gudgeon)
    t = result.time
    for turn in (0, 1):
        alpha = np.radians(-110) + SPEED * t - 2 * np.pi * turn
        beta, slope, second = exact(alpha)
        angle = result.item("bodies/angle", "wheel") + np.pi / 2 * turn
        rate = result.item("bodies/angular_velocity", "wheel")
        inside = abs(alpha) < np.pi / 4
        distance = np.sqrt(A**2 + R**2 - 2 * A * R * np.cos(alpha))
        off = distance * np.sin(angle - beta)
        deepest = result.contacts["peak_penetration"].max()
        assert deepest < 1e-5
        assert abs(off[inside]).max() < PLAY + deepest
        if turn == 0:  # the start is exact
            assert off[inside].max() > 0.99 * PLAY and off[inside].min() < -0.99 * PLAY
        column = list(result.read("clearances/contact_joint")).index(f"slot{3 + turn}")
        force = result.read("clearances/contacts/normal_force")[:, column]
        friction = result.read("clearances/contacts/friction_force")[:, column]
        for window, side in ((np.radians([-25, -15]), 1), (np.radians([25, 40]), -1)):  # speeding up, slowing down: after the bounces
            lying = (alpha > window[0]) & (alpha < window[1])
            assert lying.sum() > 5 and force[lying].min() > 0
            # of a play that is taken up evenly: beta is less by PLAY/distance
            drift = side * PLAY * A * R * np.sin(alpha) / distance**3 * SPEED
            assert_close(rate[lying], (SPEED * slope - drift)[lying], absolute=2e-4 * SPEED, what="rate")
            moment = 1.5e-3 * SPEED**2 * second + 2e-3 * rate
            assert_close(force[lying] * -side * distance[lying], moment[lying], relative=0.02, absolute=0.0061 * abs(friction[lying]).max(), what="moment")
    rest = (alpha > np.radians(100 - 360)) & (alpha < np.radians(-100))  # both tips on the disc, between the slots
    assert rest.sum() > 200
    assert abs(angle[rest]).max() < (PLAY + deepest) / (A * np.sin(np.radians(40)))
    assert abs(result.summary["energy_residual_max"]) < 1e-8 * result.summary["energy_max"]


@pytest.mark.parametrize("moment", [0.3, -0.3])
def test_disc_holds_the_wheel(gudgeon, moment):
    """A moment on the wheel turns it until a tip of an arc is on the disc, by the clearance over its lever, and no further."""
    text = DECK + f"\n[force.torque]\nname body moment[N.m]\nload wheel {moment}\n"
    text = text.replace("0       0       -110", "0       0       150").replace("2 turns of motor", "0.1 turns of motor")
    result = deck_run(gudgeon, text)
    lever = A * np.sin(np.radians(40))  # of the normal at a tip about the axle of the wheel
    angle = result.item("bodies/angle", "wheel")
    deepest = result.contacts["peak_penetration"].max()
    assert deepest < 1e-5
    assert_close(angle[-1], np.sign(moment) * PLAY / lever, absolute=(deepest + 1e-7) / lever, what="angle")
    assert abs(angle).max() < 1.002 * (PLAY + deepest) / lever
    assert len(result.contacts) > 0 and all(plain(name).startswith("lock") for name in result.contacts["item"])


def test_methods_agree_on_the_first_impacts(gudgeon):
    """Explicit, automatic and implicit."""
    text = DECK.replace("2 turns of motor", "0.21 s").replace("1e-9\n", "1e-10\n")
    runs = [deck_run(gudgeon, text, "--method", method) for method in ("verner", "auto", "radau")]
    for other in runs[1:]:
        assert len(other.contacts) == len(runs[0].contacts) >= 4
        assert_close(other.contacts["time"], runs[0].contacts["time"], absolute=1e-8, what="onsets")
        assert_close(other.contacts["impact_speed"], runs[0].contacts["impact_speed"], relative=1e-5, what="speeds")
        assert_close(other.contacts["peak_force"], runs[0].contacts["peak_force"], relative=1e-5, what="forces")


def test_turned_and_shifted(gudgeon):
    """The same mechanism elsewhere: onsets, speeds and angles."""
    turn, shift = 0.7, np.array([31.0, -17.0])
    c, s = np.cos(turn), np.sin(turn)
    text = DECK.replace("2 turns of motor", "0.5 turns of motor")
    moved = text
    for old, new in (
        ("0       0       -110", f"{shift[0]} {shift[1]} {-110 + np.degrees(turn):.15g}"),
        ("{a}     0       0", f"{100 * c + shift[0]:.15g} {100 * s + shift[1]:.15g} {np.degrees(turn):.15g}"),
        ("axle     ground   0        0", f"axle ground {shift[0]} {shift[1]}"),
        ("pivot    ground   {a}      0", f"pivot ground {100 * c + shift[0]:.15g} {100 * s + shift[1]:.15g}"),
    ):
        assert moved.count(old) == 1
        moved = moved.replace(old, new)
    one, two = deck_run(gudgeon, text), deck_run(gudgeon, moved)
    assert len(one.contacts) == len(two.contacts) >= 10
    assert_close(two.contacts["time"][:6], one.contacts["time"][:6], absolute=1e-8, what="onsets")
    assert_close(two.contacts["impact_speed"][:6], one.contacts["impact_speed"][:6], relative=1e-5, what="speeds")
    assert_close(two.item("bodies/angle", "wheel") - turn, one.item("bodies/angle", "wheel"), absolute=1e-6, what="angle")


# the shock at the entry

LENGTH, BOTTOM, HALF, PIN = R - 0.027, 0.027, 0.00605, 0.006
CRANK, WHEEL = 1.5e-3, 8e-4


def entry(late, stiffness, restitution):
    """A crank that is free meets a slot of a wheel that stands wrong; both are at rest against nothing else."""
    return f"""
[scene]
gravity = 0 0 m/s^2
[bodies]
name mass[kg] inertia[kg.m^2] x[m] y[m] angle[rad] omega[rad/s]
crank 0.8 {CRANK} 0 0 -1.2 6
wheel 0.6 {WHEEL} {A} 0 {late:.17g} 0
[points]
name body xi[m] eta[m]
axle ground 0 0
pivot ground {A} 0
hub crank 0 0
pin crank {R:.17g} 0
centre wheel 0 0
root wheel {-BOTTOM * np.sqrt(0.5):.17g} {-BOTTOM * np.sqrt(0.5):.17g}
[joint.revolute]
name i j
bearing axle hub
post pivot centre
{STEEL}
[clearance.slot]
name slot pin axis axis_angle[deg] length[m] open_end width[m] radius[m] material law
slot root pin x 225 {LENGTH:.17g} on {2 * HALF:.17g} {PIN} steel hard
[contact.kelvin_voigt]
name stiffness[N/m] restitution
hard {stiffness} {restitution}
"""


def gap(alpha, late):
    """Distance of the pin from the nearer wall, a segment, less its radius; and the unit vector to it."""
    p = R * np.array([np.cos(alpha), np.sin(alpha)])
    direction = np.array([np.cos(late + 1.25 * np.pi), np.sin(late + 1.25 * np.pi)])
    across = np.array([-direction[1], direction[0]])
    found = []
    for side in (1, -1):
        start = np.array([A, 0]) + BOTTOM * direction + side * HALF * across
        to = np.clip((p - start) @ direction, 0, LENGTH) * direction + start - p
        found.append((np.linalg.norm(to), to / np.linalg.norm(to), to + p))
    distance, n, place = min(found, key=lambda one: one[0])
    return distance - PIN, n, place


@pytest.mark.parametrize("restitution", [0.4, 1.0])
@pytest.mark.parametrize("late", [0.03, -0.03, 3e-4])
def test_shock_at_the_entry(gudgeon, late, restitution):
    """Crank and wheel after the first impact, on a corner or on a wall, tend to Newton's law of restitution with the angular momenta
    that the axles leave, as the contact becomes stiffer."""
    alphas = np.linspace(-1.2, -0.3, 6000)
    signs = np.array([gap(alpha, late)[0] for alpha in alphas])
    assert signs[0] > 0 and signs.min() < 0
    first = int(np.argmax(signs < 0))
    alpha = brentq(lambda angle: gap(angle, late)[0], alphas[first - 1], alphas[first], xtol=1e-15)
    _, n, place = gap(alpha, late)
    arm_crank = place[0] * n[1] - place[1] * n[0]
    arm_wheel = (place[0] - A) * n[1] - place[1] * n[0]
    impulse = (1 + restitution) * arm_crank * 6 / (arm_crank**2 / CRANK + arm_wheel**2 / WHEEL)
    after = np.array([6 - arm_crank * impulse / CRANK, arm_wheel * impulse / WHEEL])
    found = []
    for stiffness in (1e9, 1e11):
        text = entry(late, stiffness, restitution)
        end = (alpha + 1.2) / 6
        long = 2.2 * np.pi * np.sqrt(1 / stiffness / (arm_crank**2 / CRANK + arm_wheel**2 / WHEEL))
        result = run(gudgeon, text, f"{end + long:.17g} s", every=f"{end + long:.17g} s", tolerance="1e-12")
        assert len(result.contacts) == 1
        assert_close(result.contacts["time"], end, absolute=1e-11, what="onset")
        assert_close(result.contacts["impact_speed"], arm_crank * 6, relative=1e-9, what="speed")
        found.append(result.read("bodies/angular_velocity")[-1])
        assert abs(result.summary["energy_residual_max"]) < 1e-9 * result.summary["energy_max"]
    errors = np.array(found) - after  # they go as the duration of the contact, the root of 1/stiffness
    assert_close(errors[1], errors[0] / 10, absolute=0.01 * abs(errors[0]).max(), what="order")
    assert_close((10 * found[1] - found[0]) / 9, after, absolute=2e-5, what="limit")


def loose(joint):
    """A pin flies at the corner of a mouth of a plate that is free."""
    return f"""
[scene]
gravity = 0 0 m/s^2
[bodies]
name mass[kg] inertia[kg.m^2] x[mm] y[mm] vx[m/s] vy[m/s] omega[rad/s]
plate 1 2e-3 0 0 0 0 2
bob 0.2 4e-5 60 10 -1 -0.2 30
[points]
name body xi[mm] eta[mm]
s plate 0 0
k plate 40 6
p bob 0 0
{STEEL}
{joint}
[contact.kelvin_voigt]
name stiffness[N/m] restitution
linear 1e6 0.7
[friction.coulomb]
name coefficient
stick 0.25
[guards]
penetration = 0
"""


def test_corner_is_a_disc_of_no_radius(gudgeon):
    """The corner of a mouth against clearance.discs: motion and contact, with friction."""
    slot = "[clearance.slot]\nname slot pin axis length[mm] open_end width[mm] radius[mm] material law friction\nhit s p x 40 on 12 5 steel linear stick\n"
    disc = "[clearance.discs]\nname i j radius_i[mm] radius_j[mm] material law friction\nhit k p 1e-9 5 steel linear stick\n"
    one, two = (run(gudgeon, loose(joint), "40 ms", start="given") for joint in (slot, disc))
    assert len(one.contacts) == len(two.contacts) == 1
    for name in ("time", "impact_speed", "peak_force", "duration", "impulse", "energy_lost"):
        assert_close(one.contacts[name], two.contacts[name], relative=1e-7, absolute=1e-12, what=name)
    for name in ("position", "velocity", "angular_velocity"):
        expected = two.read(f"bodies/{name}")
        assert_close(one.read(f"bodies/{name}"), expected, absolute=1e-8 * abs(expected).max(), what=name)


@pytest.mark.parametrize(
    ("columns", "cells"),
    [("length[mm]", "0"), ("arc_radius[mm] arc[deg]", "40 360"), ("x y closed", '"40 0 -40 0 mm" "0 40 0 -40 mm" on')],
)
def test_no_end_to_open(gudgeon, columns, cells):
    """A round hole and closed grooves have no end that could be open."""
    joint = f"[clearance.slot]\nname slot pin axis {columns} open_end width[mm] radius[mm] material law\nhit s p x {cells} on 12 5 steel linear\n"
    done = run(gudgeon, loose(joint), "1 ms", expect=3)
    assert "has no end that could be open" in done.stderr, done.stderr
    assert "scene.deck:" in done.stderr and "^" in done.stderr


def test_in_space_it_is_refused(gudgeon):
    """Slots are of the plane."""
    done = run(gudgeon, loose("").replace("[scene]\n", "[scene]\nspace = spatial\n") + "[clearance.slot]\nname slot pin open_end\nhit s p on\n", "1 ms", expect=3)
    assert "clearance.slot" in done.stderr


def test_restart(gudgeon):
    """A checkpoint while the pin is in a slot is continued to the bit."""
    directory = scratch()
    path = written(directory, DECK.replace("2 turns of motor", "0.25 turns of motor"))
    call(gudgeon, "run", path, "--verify-restart", "--quiet", "--write", "channels", "--out", directory / "out")
