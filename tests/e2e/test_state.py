"""State equations: motors with controllers against exact solutions, samples against difference equations, restarts, modes, refusals."""

import json

import h5py
import numpy as np
import pytest
from scipy.linalg import expm
from support import ROOT, Run, assert_close, call, changed, run_with, scratch, text_of, written
from test_modes import assert_same_eigenvalues, eigenvalues, modes_of

R, L, K, J, B, KP, KI, REF = 0.5, 2e-3, 0.1, 2e-3, 1e-3, 0.8, 6.0, 50.0

ROTOR = """deck = 1
[scene]
title = "Rotor"
[parameters]
kp = 0.8 V.s/rad
[bodies]
name    mass[kg]   inertia[kg.m^2]
rotor   1          2e-3
[points]
name    body     xi[m]
o       ground   0
a       rotor    0
[joint.revolute]
name    i   j
shaft   o   a
"""

MOTOR = ROTOR + """[state]
name      unit   rate                                                                         value
i         A      {(state.u - 0.5 Ohm*state.i - 0.1 V.s/rad*rotor.angular_velocity)/2 mH}       -
z         rad    {50 rad/s - rotor.angular_velocity}                                           -
u         V      -                                                                            {kp*(50 rad/s - rotor.angular_velocity) + 6 V/rad*state.z}
[force.torque]
name    body    moment
motor   rotor   {0.1 N.m/A*state.i - 1e-3 N.m.s/rad*rotor.angular_velocity}
[analysis.dynamic]
end       = 0.4 s
tolerance = 1e-12
[output]
every     = 10 ms
channels  = state.* rotor.angular_velocity motor.moment
"""

# of (angular velocity, current, integral)
A = np.array([[-B / J, K / J, 0], [(-KP - K) / L, -R / L, KI / L], [-1, 0, 0]])
FORCED = np.array([0, KP * REF / L, REF])


def exact(times):
    """The step response from rest."""
    rest = -np.linalg.solve(A, FORCED)
    return np.array([rest - expm(A * t) @ rest for t in times])


def columns(run):
    return np.column_stack([run.item("bodies/angular_velocity", "rotor"), run.read("states/i"), run.read("states/z")])


@pytest.mark.parametrize("method", ["verner", "dop853", "radau", "auto", "rk4", "rock4", "adams", "bdf", "ida"])
def test_step_response(gudgeon, method):
    """A PI-controlled motor against the exact solution of its linear equations."""
    settings = {"step": "20 us"} if method == "rk4" else {}
    run = run_with(gudgeon, MOTOR, method=method, **settings)
    right = exact(run.time)
    allowed = {"adams": 1e-7, "bdf": 1e-7, "ida": 1e-7}.get(method, 1e-9)
    assert_close(columns(run) / np.abs(right).max(axis=0), right / np.abs(right).max(axis=0), absolute=allowed, what=method)
    assert_close(run.read("states/u"), KP * (REF - right[:, 0]) + KI * right[:, 2], absolute=1e3 * allowed, what="voltage")
    assert_close(run.item("forces/moment", "motor"), K * right[:, 1] - B * right[:, 0], absolute=1e2 * allowed, what="moment")


def test_order(gudgeon):
    """The classical Runge-Kutta method keeps its order, states and motion alike."""
    errors = []
    for step in ("0.4 ms", "0.2 ms", "0.1 ms"):
        run = run_with(gudgeon, MOTOR, method="rk4", step=step)
        errors.append(np.abs(columns(run) - exact(run.time)).max(axis=0))
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert orders.min() > 3.8 and orders.max() < 4.5, orders


def test_closed_loop(gudgeon):
    """Eigenvalues of the closed loop: those of the linear equations, and zero of the angle, which nothing reads."""
    summary, _ = modes_of(gudgeon, MOTOR + "[modes]\nat = time\ntime = 0.1 s\n")
    assert summary["linear_model"]["states"] == 4
    found = eigenvalues(summary)
    assert np.abs(found).min() < 1e-6
    assert_same_eigenvalues(np.delete(found, np.abs(found).argmin()), np.linalg.eigvals(A), 1e-8, "closed loop")


SAMPLED = ROTOR + """[state]
name      unit   next                                                                        every
z         rad    {state.z + 2 ms*(50 rad/s - rotor.angular_velocity)}                        2ms
m         N.m    {0.04 N.m.s/rad*(50 rad/s - rotor.angular_velocity) + 0.3 N.m/rad*(state.z + 2 ms*(50 rad/s - rotor.angular_velocity))}   2ms
slow      1      {state.slow + 1}                                                            7ms
[force.torque]
name    body    moment
motor   rotor   {state.m - 1e-3 N.m.s/rad*rotor.angular_velocity}
[analysis.dynamic]
end       = 0.2 s
tolerance = 1e-12
[output]
every     = 2 ms
from      = 1 ms
channels  = state.* rotor.angular_velocity
"""


def difference_equation(n):
    """Speed, integral and moment between samples: J w' = m - B w with m held, exactly."""
    w = z = 0.0
    decay = np.exp(-B / J * 2e-3)
    rows = []
    for _ in range(n):
        error = REF - w
        z += 2e-3 * error
        m = 0.04 * error + 0.3 * z
        middle = np.exp(-B / J * 1e-3)
        rows.append((middle * w + (1 - middle) * m / B, z, m))
        w = decay * w + (1 - decay) * m / B
    return np.array(rows)


@pytest.mark.parametrize("method", ["dop853", "auto", "radau", "bdf"])
def test_sampled_controller(gudgeon, method):
    """A discrete PI controller against its difference equation; a counter of another period."""
    run = run_with(gudgeon, SAMPLED, method=method)
    right = difference_equation(len(run.time))
    found = np.column_stack([run.item("bodies/angular_velocity", "rotor"), run.read("states/z"), run.read("states/m")])
    assert_close(found, right, absolute=1e-7 if method == "bdf" else 1e-10, what=method)
    assert np.array_equal(run.read("states/slow"), 1 + np.floor(run.time / 7e-3 + 1e-9))


@pytest.mark.parametrize("text", [MOTOR, SAMPLED], ids=["continuous", "sampled"])
@pytest.mark.parametrize("method", ["dop853", "radau", "bdf"])
def test_restart(gudgeon, method, text):
    """Runs that go on from checkpoints, some of them at samples, have the same bits."""
    deck = written(scratch(), changed(text, "analysis.dynamic", method=method, checkpoint="23 ms"))
    done = call(gudgeon, "run", deck, "--out", scratch() / "out", "--verify-restart", "--write", "channels")
    assert "equal bit for bit after 3 restarts" in done.stdout


def test_sensitivity(gudgeon):
    """The derivative of the speed by a gain against a difference of exact solutions; sampled states are refused."""
    text = MOTOR + "[sensitivity]\nparameters = kp\nresults = at(rotor.angular_velocity,50ms)\n"
    out = scratch() / "out"
    call(gudgeon, "sensitivity", written(scratch(), text), "--out", out, "--quiet")
    found = json.loads((out / "summary.json").read_text())

    def speed(kp):
        a = A.copy()
        a[1, 0] = (-kp - K) / L
        rest = -np.linalg.solve(a, [0, kp * REF / L, REF])
        return (rest - expm(a * 0.05) @ rest)[0]

    derivative = (speed(KP + 1e-4) - speed(KP - 1e-4)) / 2e-4
    assert_close(found["sensitivity"]["at(rotor.angular_velocity,50ms)"]["kp"]["value"], derivative, relative=1e-6, what="by kp")
    refused = call(gudgeon, "modes", written(scratch(), SAMPLED), "--out", scratch() / "out", expect=2)
    assert "'state.z' is sampled" in refused.stderr


def test_a_sweep_changes_the_equations(gudgeon):
    """Each case has the numbers of a run with its gain."""
    out = scratch() / "out"
    deck = written(scratch(), changed(MOTOR, "analysis.dynamic", tolerance="1e-8") + "[sweep]\nkp = 0.4 0.8 1.6 V.s/rad\nkeep = channels\n")
    call(gudgeon, "sweep", deck, "--out", out, "--quiet", "--jobs", 1)
    with h5py.File(out / "sweep.h5") as file:
        for k, value in enumerate(("0.4", "0.8", "1.6")):
            call(gudgeon, "run", deck, "--out", scratch_run := scratch() / "out", "--quiet", "--write", "channels", "--set", f"kp={value}V.s/rad")
            assert file[f"channels/{k + 1}/states/u"][()].tobytes() == Run(scratch_run).rows("states/u").tobytes()


def test_limits(gudgeon):
    """The example deck: current and voltage stay within their limits, the speed comes to its set point, the ledger closes."""
    text = changed(text_of(ROOT / "inputs" / "controlled_motor.deck"), "output", figures=None)
    run = run_with(gudgeon, text)
    assert run.read("states/armature").max() < 20.1 and run.read("states/voltage").max() <= 24.0
    speed = run.item("bodies/angular_velocity", "crank")
    assert speed[0] == 0 and abs(speed[-300:].mean() / (1000 * np.pi / 30) - 1) < 0.02
    assert np.abs(run.read("energy/residual")).max() < 1e-4 * run.read("energy/load_work").max()


def test_kinematics_has_no_states(gudgeon):
    """Another analysis is refused, in the deck and on the command line."""
    both = MOTOR + "[analysis.static]\n"
    done = call(gudgeon, "run", written(scratch(), both), "--analysis", "static", "--out", scratch() / "out", expect=2)
    assert "[state] needs [analysis.dynamic]" in done.stderr


@pytest.mark.parametrize("row, said", [
    ("rate\nx {sqrt(0.01 s - t)/1 s^1.5}", "t = 0.01 s"),
    ("next every\nx {state.x + sqrt(0.0105 s - t)/1 s^0.5} 1ms", "the sample of state 'x' is not finite at t = 0.011 s"),
    ("next every\nx {1/(0*state.x)} 1ms", "the sample of state 'x' is not finite at t = 0 s"),
    ("value\nx {log(0.01 - t/1 s)}", "t = 0.01 s"),
])
def test_what_is_not_finite(gudgeon_debug, row, said):
    """States that stop being numbers end the run with a message, in the build that traps what is no number."""
    text = ROTOR + f"[state]\nname {row}\n[force.torque]\nname body moment\nm rotor {{1 N.m*state.x}}\n[analysis.dynamic]\nend = 0.1 s\n"
    done = call(gudgeon_debug, "run", written(scratch(), text), "--out", scratch() / "out", "--quiet", expect=5)
    assert said in done.stderr, done.stderr


def test_in_space(gudgeon):
    """The same motor about the z axis of a spatial scene has the motion of the plane."""
    flat = run_with(gudgeon, MOTOR, method="dop853")
    text = (MOTOR.replace("[parameters]", "space = spatial\n[parameters]").replace("inertia[kg.m^2]", "ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2]")
            .replace("rotor   1          2e-3", "rotor 1 2e-3 2e-3 2e-3").replace("name    i   j\nshaft   o   a", 'name i j axis_i\nshaft o a "0 0 1"')
            .replace("rotor.angular_velocity -", "rotor.angular_velocity.z -").replace("rotor.angular_velocity)", "rotor.angular_velocity.z)")
            .replace("rotor.angular_velocity}", "rotor.angular_velocity.z}").replace("body    moment\nmotor   rotor   {", "body mz\nmotor rotor {"))
    space = run_with(gudgeon, text, method="dop853")
    assert_close(space.read("states/i"), flat.read("states/i"), absolute=1e-9, what="current")
