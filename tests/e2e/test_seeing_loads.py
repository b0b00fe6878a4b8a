"""Loads that see the motion: drag, motor curves, dampers that are not linear, against closed forms, by every method."""

import json

import h5py
import numpy as np
import pytest
from support import assert_close, call, scratch, written

METHODS = ["verner", "dop853", "rock4", "radau", "adams", "bdf", "ida", "rk4"]

SLED = """deck = 1
[bodies]
name mass[kg] inertia[kg.m^2] x[m] y[m] angle[rad] vx[m/s]
sled 2 1 0 0 0 10
[points]
name body xi[m] eta[m]
o ground 0 0
c sled 0 0
[joint.translational]
name i j axis
guide o c x
LOADS
[analysis.dynamic]
end = 2 s
tolerance = 1e-9
method = METHOD
EXTRA
[output]
every = 20 ms
"""

ROTOR = """deck = 1
[bodies]
name mass[kg] inertia[kg.m^2] x[m] y[m] angle[rad]
rotor 2 0.3 0 0 0
[points]
name body xi[m] eta[m]
o ground 0 0
c rotor 0 0
[joint.revolute]
name i j
shaft o c
LOADS
[analysis.dynamic]
end = 2 s
tolerance = 1e-9
method = METHOD
EXTRA
[output]
every = 20 ms
"""

DRAG = "[force.point]\nname point fx\ndrag c {-0.3 kg/m*sled.velocity.x*abs(sled.velocity.x)}"
POINT_DRAG = "[force.point]\nname point fx\ndrag c {-0.3 kg/m*c.velocity.x*abs(c.velocity.x)}"
SEEN_DRAG = (
    "[request.motion]\nname point from\nway c o\n"
    "[force.point]\nname point fx\ndrag c {-0.3 kg/m*way.velocity.x*abs(way.distance_rate)}"
)
DAMPER = "[force.spring]\nname i j damper\ndash o c {0.3 kg/m*v*abs(v)}"
MOTOR = "[force.torque]\nname body moment\nmotor rotor {5 N.m*(1 - rotor.angular_velocity/60rad/s)}"
CURVE = (
    '[function.samples]\nname at value beyond\ncurve "0 20 40 60 80 rad/s" "5 3.3333333333333333 1.6666666666666667 0 '
    '-1.6666666666666667 N.m" linear\n[force.torque]\nname body moment\nmotor rotor {curve(rotor.angular_velocity)}'
)
TURNED = "[force.torsion_spring]\nname i j actuator\nmotor ground rotor {-5 N.m*(1 - rotor.angular_velocity/60rad/s)}"


def run(program, text, loads, method="verner", extra=""):
    """Times, the file and the summary of a run."""
    directory = scratch()
    extra = "step = 1 ms" if method == "rk4" else extra
    text = text.replace("LOADS", loads).replace("METHOD", method).replace("EXTRA", extra)
    call(program, "run", written(directory, text), "--out", directory / "o", "--quiet")
    file = h5py.File(directory / "o" / "run.h5")
    return file["time"][:], file, json.loads((directory / "o" / "summary.json").read_text())


@pytest.mark.parametrize("method", METHODS)
def test_quadratic_drag(gudgeon, method):
    """m v' = -k v |v|: v = v0/(1 + k v0 t/m), x = m/k ln(1 + k v0 t/m)."""
    t, file, summary = run(gudgeon, SLED, DRAG, method)
    wear = 1 + 0.3 * 10 * t / 2
    assert_close(file["bodies/velocity"][:, 0, 0], 10 / wear, 1e-6)
    assert_close(file["bodies/position"][:, 0, 0], 2 / 0.3 * np.log(wear), 1e-6)
    assert_close(file["forces/force"][:, 0, 0], -0.3 * (10 / wear) ** 2, 1e-5)
    assert summary["energy_residual_max"] < 1e-5


@pytest.mark.parametrize("loads", [POINT_DRAG, SEEN_DRAG, DAMPER])
def test_drag_in_other_words(gudgeon, loads):
    """The same drag by the velocity of a point, by a row of [request.motion], and as a damper, which loses what the sled loses."""
    loads = loads.replace("o c {0.3", "far c {0.3")  # points that coincide have no direction
    text = SLED.replace("o ground 0 0\n", "o ground 0 0\nfar ground -5 0\n")
    t, file, _ = run(gudgeon, text, loads)
    wear = 1 + 0.3 * 10 * t / 2
    assert_close(file["bodies/velocity"][:, 0, 0], 10 / wear, 1e-6)
    lost = 100 - (10 / wear) ** 2
    name = "dissipated_damper" if "damper" in loads else "load_work"
    assert_close(file[f"energy/{name}"][:], lost if "damper" in loads else -lost, 1e-5)


WAYS = [(MOTOR, name) for name in METHODS] + [(CURVE, "verner"), (CURVE, "ida"), (TURNED, "verner"), (TURNED, "ida")]


@pytest.mark.parametrize("loads, method", WAYS)
def test_motor_curve(gudgeon, loads, method):
    """I w' = T (1 - w/w0): w = w0 (1 - exp(-T t/(I w0))), from an expression, from samples, and between two bodies."""
    t, file, _ = run(gudgeon, ROTOR, loads, method)
    assert_close(file["bodies/angular_velocity"][:, 0], 60 * (1 - np.exp(-5 * t / (0.3 * 60))), 1e-5)


def test_spring_on_a_seen_position_stands_still(gudgeon):
    """A force that sees a position is found by a static analysis: 40 N/m (x - 0.25 m) pulls back against 4 N."""
    text = SLED.replace("vx[m/s]", "").replace("sled 2 1 0 0 0 10", "sled 2 1 0 0 0")
    text = text.replace("[analysis.dynamic]\nend = 2 s\ntolerance = 1e-9\nmethod = METHOD\nEXTRA\n", "[analysis.static]\n")
    _, file, summary = run(gudgeon, text, "[force.point]\nname point fx\npull c {4 N - 40 N/m*(sled.position.x - 0.25 m)}")
    assert_close(file["bodies/position"][0, 0, 0], 0.35, 1e-9)
    assert summary["equilibrium"].startswith("stable")


def test_time_switches_are_instants_still(gudgeon):
    """A brake that comes on at 0.7 s: an instant, though the load sees the motion. v falls linearly with time before, then faster."""
    loads = "[force.point]\nname point fx\nbrake c {-step(t - 0.7 s)*4 N.s/m*sled.velocity.x}"
    t, file, _ = run(gudgeon, SLED, loads)
    assert_close(file["bodies/velocity"][:, 0, 0], 10 * np.exp(-2 * np.maximum(t - 0.7, 0)), 1e-7)
    told = call(gudgeon, "explain", written(scratch(), SLED.replace("LOADS", loads).replace("METHOD", "verner").replace("EXTRA", "")))
    assert "brake.fx: not smooth at t = 0.7 s" in told.stdout
    assert "brake.fx depends on sled.velocity.x" in told.stdout


@pytest.mark.parametrize("method", ["verner", "adams", "ida"])
def test_jump_in_what_a_load_sees(gudgeon, method):
    """A brake of 10 N that lets go below 5 m/s is no instant, but met by shorter steps."""
    t, file, _ = run(gudgeon, SLED, "[force.point]\nname point fx\nbrake c {-step(sled.velocity.x - 5 m/s)*10N}", method)
    assert_close(file["bodies/velocity"][:, 0, 0], np.maximum(10 - 5 * t, 5), 1e-6)


def test_in_space(gudgeon):
    """Quadratic drag on a ball that flies, along three axes: against scipy."""
    from scipy.integrate import solve_ivp

    speed = "sqrt(ball.velocity.x^2 + ball.velocity.y^2 + ball.velocity.z^2)"
    text = (
        "deck = 1\n[scene]\nspace = spatial\ngravity = 0 0 -9.81 m/s^2\n[bodies]\n"
        "name mass[kg] ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2] x[m] y[m] z[m] vx[m/s] vy[m/s] vz[m/s]\n"
        "ball 0.5 0.1 0.1 0.1 0 0 0 3 4 12\n[points]\nname body\nc ball\n[force.point]\nname point fx fy fz\n"
        + "drag c "
        + " ".join("{-0.02 kg/m*" + speed + f"*ball.velocity.{a}" + "}" for a in "xyz")
        + "\n[analysis.dynamic]\nend = 2 s\ntolerance = 1e-10\n[output]\nevery = 50 ms\n"
    )
    directory = scratch()
    call(gudgeon, "run", written(directory, text), "--out", directory / "o", "--quiet")
    file = h5py.File(directory / "o" / "run.h5")
    wanted = solve_ivp(
        lambda _, v: -0.04 * np.linalg.norm(v) * v - [0, 0, 9.81], (0, 2), [3, 4, 12], rtol=1e-11, atol=1e-12, t_eval=file["time"][:]
    )
    assert_close(file["bodies/velocity"][:, 0], wanted.y.T, 1e-7)


@pytest.mark.parametrize(
    "channel, words",
    [
        ("sled.acceleration.x", "a load cannot use"),
        ("slid.velocity.x", "did you mean 'sled.velocity.x'"),
        ("sled.velocity", "several components"),
        ("sled.velocity.z", "several components"),
        ("sled.velocity.w", "is not a component"),
        ("c.angle", "only planar bodies have an angle"),
    ],
)
def test_mistakes(gudgeon, channel, words):
    """Each is told with its place."""
    loads = "[force.point]\nname point fx\ndrag c {-3 N*0*(" + channel + ")/1m*1s/1rad}"
    text = SLED.replace("LOADS", loads).replace("METHOD", "verner").replace("EXTRA", "")
    done = call(gudgeon, "check", written(scratch(), text), expect=3)
    assert "^" in done.stderr and (words in done.stderr or "dimension" in done.stderr), done.stderr
