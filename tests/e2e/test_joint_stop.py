"""Stops of joints against closed forms: onsets, impact speeds, rebounds, rest, and what a row may not say."""

import numpy as np
import pytest
from scipy.special import ellipj, ellipk
from support import Run, assert_close, call, plain, scratch, written

G = 9.81
WAYS = [{}, {"coordinates": "full"}, {"method": "ida"}, {"method": "bdf"}, {"method": "rk4", "step": "10 us"}]
LAW = "[contact.exact]\nname stiffness[N/m^1.5] restitution\nhard 1e10 {}\n"


def run(program, text, end, every="1 ms", expect=0, tolerance="1e-10", analysis="dynamic", **settings):
    """Run a deck given as text."""
    directory = scratch()
    more = "".join(f"{key} = {value}\n" for key, value in settings.items())
    if analysis == "dynamic":
        more += f"end = {end}\ntolerance = {tolerance}\n"
    text = f"deck = 1\n{text}\n[analysis.{analysis}]\n{more}[output]\nevery = {every}\n"
    done = call(program, "run", written(directory, text), "--out", directory / "out", "--quiet", expect=expect)
    return Run(directory / "out", done)


def slider(speed, limits, restitution, tilt=0.0, gravity=0.0):
    """A block of 2 kg on a guide through the origin."""
    c, s = np.cos(tilt), np.sin(tilt)
    return LAW.format(restitution) + f"""
[scene]
gravity = 0 -{gravity} m/s^2
[bodies]
name mass[kg] inertia[kg.m^2] x[m] y[m] angle[rad] vx[m/s] vy[m/s]
block 2 0.1 0 0 {tilt:.17g} {speed * c:.17g} {speed * s:.17g}
[points]
name body xi[m] eta[m]
foot ground 0 0
shoe block 0 0
[joint.translational]
name i j axis axis_angle[rad]
way foot shoe x {tilt:.17g}
[clearance.stop]
name joint {" ".join(limits)} law
end way {" ".join(limits.values())} hard
"""


@pytest.mark.parametrize("restitution", [1.0, 0.6, 0.2])
@pytest.mark.parametrize("settings", WAYS, ids=str)
def test_slider_rebounds(gudgeon, settings, restitution):
    """It arrives at gap/v with v, stored as impact speed, and leaves with c_e v, to the other end."""
    speed = 1.5
    result = run(gudgeon, slider(speed, {"lower[mm]": "-20", "upper[mm]": "30"}, restitution, tilt=0.3), "0.08 s", **settings)
    first = result.contacts[0]
    fine = 1e-9 if settings.get("method") != "rk4" else 1e-6
    assert plain(first["contact"]).strip() == "upper"
    assert_close(first["time"], 0.03 / speed, absolute=fine, what="onset")
    assert_close(first["impact_speed"], speed, relative=fine, what="impact speed")
    velocity = result.item("bodies/velocity", "block") @ [np.cos(0.3), np.sin(0.3)]
    after = np.flatnonzero(result.time > first["time"] + 3e-3)  # the contact has ended
    assert_close(velocity[after][0], -restitution * speed, absolute=1e-5 * speed, what="rebound")
    lost = 0.5 * 2 * speed**2 * (1 - restitution**2)
    assert_close(result.read("energy/dissipated_contact").ravel()[after][0], lost, absolute=1e-4, what="lost in the contact")
    assert abs(result.read("energy/residual")).max() < (1e-5 if settings.get("method") != "rk4" else 1e-3)


def bar(angle, rate, limits, restitution, gravity, lever=0.25):
    """A slim bar of 3 kg and 0.8 m on a pin at its end."""
    c, s = np.cos(angle), np.sin(angle)
    return LAW.format(restitution) + f"""
[scene]
gravity = 0 -{gravity} m/s^2
[bodies]
name mass[kg] inertia[kg.m^2] x[m] y[m] angle[rad] vx[m/s] vy[m/s] omega[rad/s]
bar 3 0.16 {0.4 * c:.17g} {0.4 * s:.17g} {angle:.17g} {-0.4 * s * rate:.17g} {0.4 * c * rate:.17g} {rate}
[points]
name body xi[m] eta[m]
axle ground 0 0
end bar -0.4 0
[joint.revolute]
name i j
pin axle end
[clearance.stop]
name joint {" ".join(limits)} lever[m] law
bump pin {" ".join(limits.values())} {lever} hard
"""


@pytest.mark.parametrize("settings", WAYS, ids=str)
@pytest.mark.parametrize("side", [1, -1])
def test_bar_turns_against_its_stop(gudgeon, settings, side):
    """Without weight it turns uniformly: onset at angle/w, impact speed l w, and it comes back with c_e w."""
    rate, restitution = side * 4.0, 0.7
    limits = {"lower[deg]": "-25", "upper[deg]": "40"}
    result = run(gudgeon, bar(0.1, rate, limits, restitution, 0.0), "0.2 s", **settings)
    limit = np.radians(40 if side > 0 else -25)
    first = result.contacts[0]
    fine = 1e-9 if settings.get("method") != "rk4" else 1e-6
    assert plain(first["contact"]).strip() == ("upper" if side > 0 else "lower")
    assert_close(first["time"], (limit - 0.1) / rate, absolute=fine, what="onset")
    assert_close(first["impact_speed"], 0.25 * abs(rate), relative=fine, what="impact speed")
    after = (result.time > first["time"] + 3e-3) & (result.time < first["time"] + 10e-3)
    omega = result.read("bodies/angular_velocity").ravel()[after]
    assert_close(omega, -restitution * rate + 0 * omega, absolute=1e-4 * abs(rate), what="rebound")
    # the hinge feels the bumper, for the force is across the lever and no couple: m L alpha = F + R with I alpha = l F
    push, reaction = np.linalg.norm(result.rows("clearances/force")[:, 0], axis=1), result.rows("joints/force")[:, 0]
    hardest = push.argmax()
    assert push[hardest] > 1e3
    assert_close(np.linalg.norm(reaction[hardest]), push[hardest] * abs(3 * 0.4 * 0.25 / 0.64 - 1), relative=1e-2, what="hinge")


def test_pendulum_meets_its_stop(gudgeon):
    """Let go from rest, its time to the lowest place is a quarter of the period, an elliptic integral; there it meets the stop."""
    start = np.radians(60)  # from the vertical
    result = run(gudgeon, bar(start - np.pi / 2, 0.0, {"lower[deg]": "-90"}, 0.5, G), "1.5 s", every="2 ms")
    inertia = 0.16 + 3 * 0.4**2
    pace = np.sqrt(3 * G * 0.4 / inertia)
    k = np.sin(start / 2)
    quarter = ellipk(k**2) / pace
    first = result.contacts[0]
    assert_close(first["time"], quarter, absolute=1e-8, what="onset")
    assert_close(first["impact_speed"], 0.25 * 2 * k * pace, relative=1e-7, what="impact speed")
    before = result.time < quarter
    sine, _, _, _ = ellipj(ellipk(k**2) - pace * result.time[before], k**2)
    assert_close(result.read("bodies/angle").ravel()[before], 2 * np.arcsin(k * sine) - np.pi / 2, absolute=1e-8, what="fall")
    speeds = [row["impact_speed"] for row in result.contacts]
    assert len(speeds) > 1
    assert_close(speeds[1], 0.5 * speeds[0], relative=2e-3, what="second impact")
    assert abs(result.read("energy/residual")).max() < 1e-5


def test_block_rests_on_its_stop(gudgeon):
    """At rest the stop of a slope bears the weight: K delta^1.5 = m g sin(tilt)."""
    result = run(gudgeon, slider(0.0, {"lower[mm]": "0"}, 0.5, tilt=0.6, gravity=G), None, analysis="static")
    weight = 2 * G * np.sin(0.6)
    delta = result.read("clearances/contacts/penetration").ravel()
    assert_close(delta[0], (weight / 1e10) ** (2 / 3), relative=1e-6, what="penetration")
    assert_close(result.read("clearances/contacts/normal_force").ravel()[:2], [weight, 0.0], absolute=1e-6, what="force")
    assert delta[1] == 0.0


GOOD = {"lower[deg]": "-25", "upper[deg]": "40"}


@pytest.mark.parametrize("limits, change, words", [
    ({"lever[mm]": "1"}, None, ["has no limit", "give lower, upper, or both"]),
    ({"lower[deg]": "10", "upper[deg]": "5"}, None, ["no range of motion", "upper must be greater than lower"]),
    ({"lower[deg]": "-100", "upper[deg]": "90"}, None, ["half a revolution apart"]),
    ({"lower[mm]": "-25"}, None, ["a joint.revolute", "column lower is an angle there"]),
    ({"lower[deg]": "-25", "upper[mm]": "40"}, None, ["have different dimensions"]),
    ({"upper[kg]": "4"}, None, ["neither an angle nor a length"]),
    (GOOD, ("bump pin", "bump pit"), ["unknown joint 'pit'", "did you mean 'pin'? revolute or translational joints: pin"]),
    (GOOD, (" 0.25 hard", " 0 hard"), ["of an angle has no lever"]),
    (GOOD, ("hard 1e10", "hard 0"), ["gives no stiffness", "set its column stiffness"]),
], ids=str)
def test_mistakes(gudgeon, limits, change, words):
    """What a stop cannot be is said, with its place."""
    text = bar(0.1, 0.0, {k: v for k, v in limits.items() if not k.startswith("lever")}, 0.5, 0.0)
    result = run(gudgeon, text.replace(*change) if change else text, "0.1 s", expect=3)
    for word in words:
        assert word in result.done.stderr, result.done.stderr
    assert "scene.deck:" in result.done.stderr
