"""Section [guards]: what no mechanism does is told of or ends the run, and conditions end it by intent."""

import math

import pytest
from support import DECK, Run, assert_close, call, changed, scratch, written

INTEGRATION = 5
G = 9.81  # m/s^2

CRANK = """deck = 1
[bodies]
name   mass[kg]  inertia[kg.m^2]  x[mm]  y[mm]  angle[deg]
crank  0.3       1e-4             25     0      0
rod    0.2       1e-4             75     0      0
slider 0.1       1e-4             100    0      0
[points]
name   body    xi[mm]  eta[mm]
main   ground  0       0
heel   crank   -25     0
throw  crank   25      0
big    rod     -25     0
small  rod     25      0
pin    slider  0       0
fix    ground  100     0
[joint.revolute]
name   i     j
main   main  heel
bigend throw big
[joint.rigid]
name   i    j
stand  fix  pin
[driver.speed]
name   joint  speed
motor  main   1000rpm
[material]
name   young[GPa]  poisson
steel  207         0.3
[clearance.revolute]
name   bearing  journal  bearing_radius[mm]  clearance[mm]  material  law
loose  pin      small    10                  0.5            steel     hertz
[contact.hertz]
name
hertz
[analysis.dynamic]
end = 1 s
"""

FALL = f"""deck = 1
[scene]
gravity = 0 -{G} m/s^2
[bodies]
name  mass[kg]  inertia[kg.m^2]  x[m]  y[m]  vx[m/s]
ball  2         0.01             0     0     0
[points]
name    body    xi[m]  eta[m]
centre  ball    0      0
floor   ground  0      -5
[analysis.dynamic]
end = 2 s
start = given
[output]
every = 10 ms
"""

BALL = """[material]
name   young[GPa]  poisson  strength[MPa]
steel  207         0.3      2000
[clearance.plane]
name   plane  ball    axis  radius[mm]  material  law
plate  floor  centre  y     20          steel     hertz
[contact.hertz]
name
hertz
"""

OSCILLATOR = """deck = 1
[bodies]
name  mass[kg]  inertia[kg.m^2]  x[m]  y[m]  vx[m/s]
bob   1         1                1     0     10
[points]
name   body    xi[m]  eta[m]
wall   ground  0      0
eye    bob     0      0
[joint.translational]
name   i     j    axis
rail   wall  eye  x
[force.spring]
name  i     j    stiffness[N/m]  free_length[m]
coil  wall  eye  100             1
[analysis.dynamic]
end = 2 s
start = given
[output]
every = 10 ms
"""


def run(program, text, *options, expect=0):
    """Run a deck given as text, without figures."""
    directory = scratch()
    done = call(program, "run", written(directory, text), "--out", directory / "out", "--write", "channels", *options, expect=expect)
    return Run(directory / "out", done)


def guarded(text, *lines):
    """A deck with a section [guards]."""
    return text + "[guards]\n" + "".join(line + "\n" for line in lines)


def test_mechanism_that_cannot_turn(gudgeon):
    """A driven crank whose rod is too short for a turn presses its loose pin through the bearing: the run ends there."""
    ended = run(gudgeon, CRANK, expect=INTEGRATION)
    assert "joint 'loose', law 'hertz': penetration" in ended.done.stderr and "guard 'penetration'" in ended.done.stderr
    assert "9.5 mm" in ended.done.stderr
    # crank and rod of 50 mm, the bearing at 100 mm: 0.5 and 9.5 mm are passed when the crank pin is 60 mm from it
    angle = 1000 * math.pi / 30 * ended.summary["time_end"]
    assert_close(math.hypot(100 - 50 * math.cos(angle), 50 * math.sin(angle)), 60.0, absolute=0.01)
    limited = run(gudgeon, guarded(CRANK, "penetration = 0.1"), expect=INTEGRATION)
    assert "0.95 mm" in limited.done.stderr and limited.summary["time_end"] < ended.summary["time_end"]
    told = run(gudgeon, guarded(changed(CRANK, "analysis.dynamic", end="5 ms"), "penetration = 0"))
    assert any("more than the clearance, 0.5 mm" in words and "first at" in words for words in told.summary["warnings"])


@pytest.mark.parametrize("method", ["verner", "adams", "bdf", "ida"])
def test_speed(gudgeon, method):
    """Nothing goes on for ever: 1 km/s is passed after v/g."""
    text = guarded(changed(FALL, "analysis.dynamic", end="1000 s", maximum_step="1 s"), "speed = 1 km/s", "travel = 0")
    ended = run(gudgeon, text, "--method", method, expect=INTEGRATION)
    assert "body 'ball'" in ended.done.stderr and "guard 'speed'" in ended.done.stderr
    assert 0 <= ended.summary["time_end"] - 1000 / G <= 1.001


def test_travel(gudgeon):
    """A body that misses the floor is told of: where, when, how far."""
    fell = run(gudgeon, guarded(changed(FALL, "analysis.dynamic", end="4 s", maximum_step="10 ms"), "travel = 10"))
    words = [w for w in fell.summary["warnings"] if "'ball'" in w]
    assert len(words) == 1 and "78.5 m from its initial position at t = 4 s" in words[0] and "15.7 times" in words[0]
    assert run(gudgeon, FALL).summary["warnings"] == []


def test_energy_of_nothing(gudgeon):
    """A fixed step beyond the bound of stability of RK4, 2.83 over the angular frequency: the oscillation grows without end."""
    text = """deck = 1
[bodies]
name   mass[kg]  inertia[kg.m^2]  x[m]  y[m]  omega[rad/s]
wheel  1         1                0     0     1
[force.torsion_spring]
name  i       j      stiffness[N.m/rad]
hair  ground  wheel  100
[analysis.dynamic]
method = rk4
step = 0.29 s
end = 120 s
start = given
[output]
every = 1 s
"""
    ended = run(gudgeon, text, expect=INTEGRATION)
    assert "the motion is not physical" in ended.done.stderr and "guard 'energy'" in ended.done.stderr
    assert ended.summary["time_end"] < 60
    stable = run(gudgeon, text.replace("0.29 s", "0.02 s"))
    assert stable.summary["status"] == "complete"
    text = guarded(text, "energy = 0")
    assert "the motion is not physical" not in run(gudgeon, text, expect=None).done.stderr


def test_strength(gudgeon):
    """Hertz: the pressure reaches p at F = pi^3 p^3 R^2 / (6 E*^2); the ball's greatest force follows from its energy."""
    modulus = 207e9 / (2 * (1 - 0.3**2))
    limit = math.pi**3 * 2e9**3 * 0.02**2 / (6 * modulus**2)
    stiffness = 4 / 3 * modulus * math.sqrt(0.02)
    peak = stiffness * (2.5 * 0.5 * 2 * 0.3**2 / stiffness) ** 0.6
    assert peak > limit
    text = changed(FALL, "scene", gravity="0 0 m/s^2").replace("0     0     0\n[points]", "0     -4.979  0\n[points]")
    text = text.replace("vx[m/s]", "vy[m/s]").replace("-4.979  0\n", "-4.979  -0.3\n") + BALL
    told = run(gudgeon, text)
    words = [w for w in told.summary["warnings"] if "strength" in w]
    assert len(words) == 1 and "joint 'plate'" in words[0] and f"the strength limit of the material is {float(f'{limit:.3g}'):.0f} N" in words[0]
    assert f"normal force up to {float(f'{peak:.3g}'):.0f} N" in words[0]
    ended = run(gudgeon, guarded(text, "strength = stop"), expect=INTEGRATION)
    assert "strength" in ended.done.stderr
    assert "strength" not in " ".join(run(gudgeon, guarded(text, "strength = off")).summary["warnings"])


@pytest.mark.parametrize("method", ["verner", "rk4", "adams", "bdf", "ida"])
def test_stop_at_a_place(gudgeon, method):
    """A fall of 3 m ends at sqrt(2 h / g), whatever the steps; the condition and the time are in the summary."""
    text = guarded(FALL, "stop = ball.velocity.y < -100 m/s or ball.position.y < -3 m")
    if method == "rk4":
        text = changed(text, "analysis.dynamic", method="rk4", step="7 ms")
    else:
        text = changed(text, "analysis.dynamic", method=method, tolerance="1e-10")
    stopped = run(gudgeon, text)
    assert_close(stopped.summary["time_end"], math.sqrt(6 / G), absolute=2e-8)
    assert stopped.summary["status"] == "complete"
    assert "stopped as requested" in stopped.summary["message"] and "ball.position.y < -3 m" in stopped.summary["message"]
    assert stopped.time[-1] <= stopped.summary["time_end"] < stopped.time[-1] + 0.01 + 1e-12
    assert stop_row(stopped, "bodies/position")[0, 1] == pytest.approx(-3, abs=1e-8)
    assert stop_row(stopped, "bodies/velocity")[0, 1] == pytest.approx(-math.sqrt(6 * G), abs=1e-7)
    names, rows = run(gudgeon, text, "--write", "all").table("ball.dat")
    assert float(rows[-1][0]) == stopped.summary["time_end"] and len(rows) == len(stopped.time) + 1
    assert float(rows[-1][names.index("ball.position.y")]) == pytest.approx(-3, abs=1e-8)


def stop_row(stopped, path):
    """A quantity in the row at which a condition ended the run: the last row, and the only one of its kind."""
    kinds, times = stopped.rows("row_kind"), stopped.rows("time")
    assert kinds[-1] == 5 and (kinds[:-1] != 5).all() and stopped.summary["stop_rows"] == 1
    assert times[-1] == stopped.summary["time_end"] > times[-2]
    return stopped.rows(path)[-1]


def test_stop_where_there_is_a_row(gudgeon):
    """A condition that is met at the start, and one beside the span that is written, bring no further row."""
    met = run(gudgeon, guarded(FALL, "stop = ball.position.y < 1 m"))
    assert list(met.rows("time")) == [0.0] and met.summary["stop_rows"] == 0
    early = run(gudgeon, changed(guarded(FALL, "stop = ball.position.y < -3 m"), "output", **{"from": "1 s"}))
    assert len(early.rows("time")) == 0 and early.summary["stop_rows"] == 0
    assert any("the time histories are empty" in words for words in early.summary["warnings"])
    assert {entry["greatest"] for entry in early.summary["extremes"]} == {None}


def test_stop_within_a_step(gudgeon):
    """x = 1 m + 1 m sin(10 t) is below 0.1 mm for 3 ms only, between the ends of longer steps."""
    text = guarded(changed(OSCILLATOR, "analysis.dynamic", tolerance="1e-6"), "stop = bob.position.x < 0.0001 m")
    stopped = run(gudgeon, text)
    assert_close(stopped.summary["time_end"], (1.5 * math.pi - math.acos(0.9999)) / 10, absolute=1e-7)
    assert_close(stop_row(stopped, "bodies/position")[0, 0], 1e-4, absolute=1e-12)


WHEEL = """deck = 1
[bodies]
name   mass[kg]  inertia[kg.m^2]  x[m]  y[m]  omega[rad/s]
wheel  1         1                0     0     100
[points]
name  body    xi[m]  eta[m]
hub   ground  0      0
axle  wheel   0      0
tip   wheel   1      0
[joint.revolute]
name  i    j
pin   hub  axle
[request]
name   value             unit
swing  {sin(700*t/1s)}   1
[analysis.dynamic]
end = 1 s
[output]
every    = 1 ms
channels = tip.position request.swing
"""


@pytest.mark.parametrize("method", ["verner", "dop853", "radau", "rock4", "adams", "bdf", "ida"])
def test_stop_within_turns_of_a_step(gudgeon, method):
    """A free wheel goes round in few steps: the first time that its tip is above 0.9 m, or a request above 0.99, ends the run."""
    stopped = run(gudgeon, guarded(WHEEL, "stop = tip.position.y > 0.9 m"), "--method", method)
    assert_close(stopped.summary["time_end"], math.asin(0.9) / 100, absolute=1e-9)
    swung = run(gudgeon, guarded(WHEEL, "stop = request.swing > 0.99"), "--method", method)
    assert (swung.read("requests/swing") <= 0.99 + 1e-12).all() and swung.summary["time_end"] < 1
    tall = run(gudgeon, guarded(WHEEL, "stop = tip.position.y > 1.0001 m"), "--method", method)
    assert tall.summary["time_end"] == 1.0


@pytest.mark.parametrize("method", ["verner", "dop853", "radau", "rock4", "adams", "bdf", "ida"])
def test_stop_within_a_contact(gudgeon, method):
    """The event table ends where the run ends: greatest force, penetration and impulse are those up to there."""
    text = changed(FALL, "scene", gravity="0 0 m/s^2").replace("0     0     0\n[points]", "0     -4.979  0\n[points]")
    text = text.replace("vx[m/s]", "vy[m/s]").replace("-4.979  0\n", "-4.979  -0.3\n") + BALL
    text = changed(guarded(text, "stop = plate.normal_force > 1 kN", "strength = off"), "output", every="1 us")
    stopped = run(gudgeon, changed(text, "analysis.dynamic", end="20 ms"), "--method", method, "--tolerance", "1e-10")
    contact, end = stopped.contacts, stopped.summary["time_end"]
    assert_close(contact["peak_force"][0], 1000.0, relative=1e-9)
    assert contact["peak_force_time"][0] <= end and contact["peak_penetration_time"][0] <= end
    assert_close(contact["impulse"][0], 2 * (stopped.rows("bodies/velocity")[-1, 0, 1] + 0.3), absolute=1e-8)
    assert contact["peak_penetration"][0] == stopped.rows("clearances/contacts/penetration")[-1, 0]


def test_stop_at_the_start_and_never(gudgeon):
    """A condition that holds at t = 0 ends the run there; one that never holds changes nothing."""
    assert run(gudgeon, guarded(FALL, "stop = ball.position.y < 1 m")).summary["time_end"] == 0.0
    free, never = run(gudgeon, FALL), run(gudgeon, guarded(FALL, "stop = ball.position.y > 1 m"))
    assert (free.read("bodies/position") == never.read("bodies/position")).all()
    assert never.summary["message"] == ""


def test_stop_on_a_contact(gudgeon):
    """The penetration of a loose pin ends the run at that penetration; with --ideal the condition is left out and said so."""
    text = changed(DECK.read_text(), "output", figures=None, every="0.1 us")
    text = guarded(text, "stop = gudgeon.penetration > {0.02*c}")
    stopped = run(gudgeon, text, "--tolerance", "1e-10")
    depth = stopped.read("clearances/contacts/penetration")
    assert 0.9e-5 < depth.max() <= 1.0e-5
    assert_close(stop_row(stopped, "clearances/contacts/penetration"), [1e-5], absolute=1e-15)
    bare = run(gudgeon, changed(text, "output", contact_rows="off"), "--tolerance", "1e-10")
    assert_close(stop_row(bare, "clearances/contacts/penetration"), [1e-5], absolute=1e-15)
    assert set(bare.rows("row_kind")) == {0, 5}
    ideal = run(gudgeon, text, "--ideal")
    assert any("ignored: the joint is ideal" in words for words in ideal.summary["warnings"])
    assert "stops as requested when gudgeon.penetration > 1e-5 m" in call(gudgeon, "explain", written(scratch(), text)).stdout
