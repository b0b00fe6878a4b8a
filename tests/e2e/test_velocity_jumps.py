"""Drivers whose velocity jumps: the bodies follow at once, by impulses. Held against the closed form of a rod on a slider."""

import json
import math

import h5py
import numpy as np
import pytest
from support import at_instants, call, changed, scratch, written
from test_driven_friction import MU, column, finished, on_plane

TURN = 1.5  # when the slider turns back [s]
MASS, INERTIA, ARM = 1.3, 0.02, 0.3  # of the rod, about its centre of mass, and from there to its hinge [kg, kg.m^2, m]
OMEGA, ANGLE = 0.8, 0.4  # of the rod at the start: without gravity it keeps turning so, on a slider of constant speed [rad/s, rad]
SLIDER = 2.0  # [kg]
TEXT = f"""deck = 1
[bodies]
name mass[kg] inertia[kg.m^2] x[m] y[m] angle[rad] vx[m/s] vy[m/s] omega[rad/s]
p {SLIDER} 0.01 {TURN} 0 0 -1 0 0
w {MASS} {INERTIA} {TURN - ARM*math.cos(ANGLE)!r} {-ARM*math.sin(ANGLE)!r} {ANGLE} """ + f"""{
-1.0 + OMEGA*ARM*math.sin(ANGLE)!r} {-OMEGA*ARM*math.cos(ANGLE)!r} {OMEGA}
[points]
name body xi[m] eta[m]
o ground 0 0
c p 0 0
h w {ARM} 0
[joint.translational]
name i j axis
t o c x
[joint.revolute]
name i j
r c h
[driver.position]
name i j axis position
lead o c x {{max({TURN} s - t, 2*(t - {TURN} s))*1 m/s}}
[analysis.dynamic]
end = 3 s
start = given
tolerance = 1e-11
[output]
every = 10 ms
"""


def run(program, **settings):
    """The rod on the slider: time, rates of both bodies, drive work and the summary."""
    directory = scratch()
    deck = written(directory, changed(TEXT, "analysis.dynamic", **settings))
    call(program, "run", deck, "--out", directory / "o", "--quiet")
    summary = json.loads((directory / "o" / "summary.json").read_text())
    with h5py.File(directory / "o" / "run.h5") as file:
        t = at_instants(file, "time")
        velocity = at_instants(file, "bodies/velocity").reshape(len(t), 2, -1)
        omega = at_instants(file, "bodies/angular_velocity").reshape(len(t), 2)
        work = at_instants(file, "energy/drive_work").reshape(-1)
    return t, velocity, omega, work, summary


def kinetic(v, omega, angle):
    """Kinetic energy of both bodies."""
    s = ARM*np.array([math.cos(angle), math.sin(angle)])  # from the centre of the rod to its hinge
    centre = np.array([v, 0.0]) - omega*np.array([-s[1], s[0]])
    return 0.5*SLIDER*v**2 + 0.5*MASS*centre @ centre + 0.5*INERTIA*omega**2


def after_the_turn():
    """Jump of the rod's rate, (J + m s^2) dw = m s x dv with dv = (3, 0) of the hinge; and all work of the driver until then."""
    angle = ANGLE + OMEGA*TURN
    jump = -MASS*ARM*math.sin(angle)*3.0/(INERTIA + MASS*ARM**2)
    return jump, kinetic(2.0, OMEGA + jump, angle) - kinetic(-1.0, OMEGA, ANGLE)


@pytest.mark.parametrize("settings", [
    dict(method="verner"), dict(method="adams"), dict(method="bdf"), dict(method="ida"), dict(method="rk4", step="2 ms"),
    dict(stabilise="projection"), dict(stabilise="none"), dict(stabilise="partitioning"), dict(solver="lapack"),
], ids=lambda settings: "_".join(settings.values()).replace(" ", ""))
def test_rod_on_a_slider_that_turns_back(gudgeon, settings):
    """Right behind the instant the velocities are those of the impulse; work of the drivers is what the bodies gained."""
    if settings.get("method") == "rk4":
        settings = dict(settings, tolerance=None)
    t, velocity, omega, work, summary = run(gudgeon, **settings)
    jump, done = after_the_turn()
    k = int(np.argmin(np.abs(t - TURN)))
    assert abs(t[k] - TURN) < 1e-12
    assert np.abs(velocity[:k, 0, 0] + 1.0).max() < 1e-8
    assert abs(velocity[k, 0, 0] - 2.0) < 1e-14 and np.abs(velocity[k:, 0, 0] - 2.0).max() < 1e-8
    assert abs(omega[k - 1, 1] - OMEGA) < 1e-8
    assert abs(omega[k, 1] - OMEGA - jump) < 1e-8 and np.abs(omega[k:, 1] - OMEGA - jump).max() < 1e-7
    assert abs(work[k] - done) < 1e-7
    assert summary["energy_residual_max"] < 1e-8*summary["energy_max"]
    words = [warning for warning in summary["warnings"] if "velocities jump" in warning]
    assert len(words) == 1 and "'lead', by 3 m/s at t = 1.5 s" in words[0]


@pytest.mark.parametrize("method", ["verner", "adams", "bdf", "ida"])
def test_friction_turns_at_once(gudgeon, method):
    """A ball on a plane that a driver turns back: friction opposes the new velocity from the instant on."""
    run = finished(gudgeon, on_plane("0.05 m - abs(t - 0.52 s)*0.1 m/s"), end="1 s", settings=f"method = {method}")
    t, normal, friction = (column(run, "f", quantity) for quantity in ("time", "normal_force", "friction_force"))
    forward, back = t < 0.52 - 1e-9, t > 0.52 + 1e-9
    ratio = friction/(MU*normal)
    assert np.abs(np.abs(ratio) - 1.0).max() < 1e-9
    assert np.ptp(np.sign(ratio[forward])) == 0 and np.ptp(np.sign(ratio[back])) == 0
    assert np.sign(ratio[forward][0]) == -np.sign(ratio[back][0])
    assert run.summary["energy_residual_max"] < 1e-7*run.summary["energy_max"]


def test_smooth_drivers_do_not_jump(gudgeon):
    """Nothing is told where only the acceleration bends."""
    text = TEXT.replace(f"max({TURN} s - t, 2*(t - {TURN} s))*1 m/s",
                        f"-1 m/s*t + {TURN} m + 0.5 m/s^2*(t - {TURN} s)*max(t - {TURN} s, 0 s)")
    directory = scratch()
    call(gudgeon, "run", written(directory, text), "--out", directory / "o", "--write", "numbers", "--quiet")
    summary = json.loads((directory / "o" / "summary.json").read_text())
    assert not [warning for warning in summary["warnings"] if "velocities jump" in warning]


PRESSED = """deck = 1
[bodies]
name mass[kg] inertia[kg.m^2] x[m] y[m] vy[m/s]
p 1 0.01 0 0.1 -0.001
[points]
name body xi[m] eta[m]
o ground 0 0
c p 0 0
[joint.translational]
name i j axis
t o c y
[driver.position]
name i j axis position
d o c y {0.1 m - 1e-5 m*min(t/10ms, 2 - t/10ms)}
[clearance.plane]
name plane ball axis radius[m] material law
f o c y 0.1 steel law
[material]
name young[GPa] poisson
steel 207 0.3
[contact.kelvin_voigt]
name stiffness[N/m] restitution
law 1e6 0.5
[analysis.dynamic]
end = 18 ms
start = given
tolerance = 1e-10
[output]
every = 1 ms
"""


@pytest.mark.parametrize("method", ["verner", "adams", "bdf", "ida"])
def test_contact_turns_at_once(gudgeon, method):
    """A ball that a driver presses into a plane and takes back: the force falls to ce^2 of the spring's at that instant."""
    directory = scratch()
    deck = written(directory, changed(PRESSED, "analysis.dynamic", method=method))
    call(gudgeon, "run", deck, "--out", directory / "o", "--quiet")
    with h5py.File(directory / "o" / "run.h5") as file:
        t, force = at_instants(file, "time"), at_instants(file, "clearances/contacts/normal_force").reshape(-1)
    depth = 1e-5*np.minimum(t/0.01, 2.0 - t/0.01)
    assert np.abs(force - 1e6*depth*np.where(t < 0.01 - 1e-9, 1.0, 0.25)).max() < 1e-6
