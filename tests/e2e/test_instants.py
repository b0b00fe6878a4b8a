"""Loads and drivers that jump, bend or are short: no step passes over them. Held against closed forms."""

import json

import h5py
import numpy as np
import pytest
from support import at_instants, call, changed, scratch, written

METHODS = ["verner", "dop853", "rock4", "radau", "adams", "bdf", "ida", "rk4"]

# One mass on a guide along x, free or on a spring.
MASS = """deck = 1
[bodies]
name mass[kg] inertia[kg.m^2] x[m] y[m] angle[rad]
p 1 1 1 0 0
[points]
name body xi[m] eta[m]
o ground 0 0
c p 0 0
[joint.translational]
name i j axis
j o c x
SPRING
[force.point]
name point fx
f c {LOAD}
[analysis.dynamic]
end = END
start = given
tolerance = 1e-10
[output]
every = 10 ms
"""
SPRING = """[force.spring]
name i j stiffness[N/m] damping[N.s/m] free_length[m]
s o c 100 2 1"""


def deck(load, end="3 s", spring="", **settings):
    """The mass under a load."""
    return changed(MASS.replace("LOAD", load).replace("END", end).replace("SPRING", spring), "analysis.dynamic", **settings)


def run(program, text, *options, expect=0):
    """Run a deck: times, positions and velocities along x, the summary and the file."""
    directory = scratch()
    call(program, "run", written(directory, text), "--out", directory / "o", *options, expect=expect)
    file = h5py.File(directory / "o" / "run.h5")
    summary = json.loads((directory / "o" / "summary.json").read_text())
    t = file["time"][:]
    return t, file["bodies/position"][:].reshape(len(t), -1), file["bodies/velocity"][:].reshape(len(t), -1), summary, file


def explain(program, text, *options):
    """What explain says of a deck."""
    return call(program, "explain", written(scratch(), text), *options).stdout


def method(name, step="1.3 ms"):
    """Settings of a method; rk4 takes fixed steps that do not fit the instants."""
    return {"method": name, "step": step} if name == "rk4" else {"method": name}


def response(t, begin, force=10.0, mass=1.0, stiffness=100.0, damping=2.0):
    """Displacement of the damped oscillator after a force that begins and stays."""
    decay = damping / (2 * mass)
    w = np.sqrt(stiffness / mass - decay**2)
    s = np.maximum(t - begin, 0)
    return force / stiffness * (1 - np.exp(-decay * s) * (np.cos(w * s) + decay / w * np.sin(w * s)))


@pytest.mark.parametrize("name", METHODS)
def test_pulse_on_an_oscillator(gudgeon, name):
    """10 N for 0.1 s after a second of rest: every method sees it, to 1e-6 of the peak."""
    t, x, *_ = run(gudgeon, deck("10N*(step(t-1s)-step(t-1.1s))", spring=SPRING, **method(name)))
    expected = response(t, 1) - response(t, 1.1)
    assert np.abs(x[:, 0] - 1 - expected).max() < 1e-6 * np.abs(expected).max()


@pytest.mark.parametrize("name", METHODS)
@pytest.mark.parametrize("slope", [1e3, 1e-3])
def test_ramp_after_a_rest(gudgeon, name, slope):
    """A force that bends after a second of rest, where nothing has said yet how fast the oscillator will be: in closed form."""
    spring = SPRING.replace("s o c 100 2 1", "s o c 100 0 1")
    t, x, *_ = run(gudgeon, deck(f"{slope!r}N/s*max(t-1.2s,0s)", spring=spring, **method(name)))
    s = np.maximum(t - 1.2, 0)
    expected = slope / 100 * (s - np.sin(10 * s) / 10)
    assert np.abs(x[:, 0] - 1 - expected).max() < 1e-6 * np.abs(expected).max()


@pytest.mark.parametrize("name", METHODS)
def test_short_rectangle(gudgeon, name):
    """1 kN for 0.1 ms: the momentum is that of the force, to round-off."""
    *_, v, _, _ = run(gudgeon, deck("1e3N*(step(t-1.2s)-step(t-1.2001s))", **method(name, "7 ms")))
    assert v[-1, 0] == pytest.approx(0.1, rel=1e-9)


@pytest.mark.parametrize("name", METHODS[:4])
def test_short_bell(gudgeon, name):
    """exp(-(t/0.1 ms)^2): smooth, and still seen."""
    _, x, v, _, _ = run(gudgeon, deck("1e3N*exp(-((t-1.2345s)/1e-4s)^2)", **method(name)))
    momentum = 0.1 * np.sqrt(np.pi)
    assert v[-1, 0] == pytest.approx(momentum, rel=1e-6)
    assert x[-1, 0] == pytest.approx(1 + momentum * (3 - 1.2345), rel=1e-6)


@pytest.mark.parametrize(
    "load, momentum",
    [
        ("1N*max(0,sin(2*pi*0.5Hz*t)-0.9)", None),
        ("1N*min(1,abs(t/1s-1.5))", None),
        ("100N*step(0.5s-abs(t-1s))*step(t-1.499s)", 0.1),
        ("1e3N/(1+((t-2s)/1e-5s)^2)", None),
        ("1e3N*(tanh((t-1s)/1e-5s)-tanh((t-1.0001s)/1e-5s))/2", 0.1),
        ("1N*acos(cos(2*pi*1Hz*t))/pi", 1.5),
        ("1N*sqrt((t/1s-1.3)^2)", (1.3**2 + 1.7**2) / 2),
        ("1N*(atan2(sin(2*pi*1Hz*t),cos(2*pi*1Hz*t))+pi)", None),
    ],
)
def test_momentum_of_loads(gudgeon, load, momentum):
    """The momentum is the integral of the load, here by quadrature on 3e6 places between the kinks, or in closed form."""
    _, _, v, _, _ = run(gudgeon, deck(load))
    t = (np.arange(3_000_000) + 0.5) * 1e-6
    values = {
        "1N*max(0,sin(2*pi*0.5Hz*t)-0.9)": lambda: np.maximum(0, np.sin(np.pi * t) - 0.9).mean() * 3,
        "1N*min(1,abs(t/1s-1.5))": lambda: np.minimum(1, np.abs(t - 1.5)).mean() * 3,
        "1e3N/(1+((t-2s)/1e-5s)^2)": lambda: 1e-2 * (np.arctan(1e5) + np.arctan(2e5)),
        "1N*(atan2(sin(2*pi*1Hz*t),cos(2*pi*1Hz*t))+pi)": lambda: 3 * np.pi,
    }
    expected = values[load]() if load in values else momentum
    assert v[-1, 0] == pytest.approx(expected, rel=1e-6, abs=1e-8)


def test_instants_at_the_ends_and_together(gudgeon):
    """Kinks at t = 0, at output instants, at the end and two at one instant; each side has its own value."""
    t, x, v, _, file = run(gudgeon, deck("1N*max(0,t/1s)+2N*step(t-1s)-2N*step(1s-t)+7N*step(t-3s)"))
    force = file["forces/force"][:].reshape(len(t), -1)[:, 0] if "forces/force" in file else None
    s = np.maximum(t - 1, 0)
    expected = t**2 / 2 - 2 * np.minimum(t, 1) + 2 * s
    assert np.abs(v[:, 0] - expected).max() < 1e-9
    assert np.abs(x[:, 0] - 1 - (t**3 / 6 - 2 * np.where(t < 1, t**2 / 2, t - 0.5) + s**2)).max() < 1e-9
    if force is not None:
        assert force[100] == pytest.approx(1 + 2)  # at an instant: behind it
        assert force[99] == pytest.approx(0.99 - 2)
        assert force[300] == pytest.approx(3 + 2 + 7)


def test_thousands_of_kinks(gudgeon):
    """6000 kinks: the momentum of abs(sin) in closed form, and work in proportion."""
    _, _, v, summary, _ = run(gudgeon, deck("1N*abs(sin(2*pi*1000Hz*t))"))
    assert v[-1, 0] == pytest.approx(3 * 2 / np.pi, rel=1e-6)  # 24,000 steps of 1e-10
    assert summary["steps"] < 20 * 6000


def test_samples_that_hold(gudgeon):
    """A curve that holds its ends bends there; a spike of its samples is not passed over."""
    head = '[function.samples]\nname at value beyond ends\nspike "1 1.0001 1.0002 1.0003 1.0004 s" "0 0 1000 0 0 N" hold clamped\n'
    text = deck("spike(t)").replace("[bodies]", head + "[bodies]", 1)
    _, _, v, _, _ = run(gudgeon, text)
    # the spline with flat ends through 0 0 1 0 0: curvatures by hand
    h = 1e-4
    a = np.array([[2, 1, 0, 0, 0], [1, 4, 1, 0, 0], [0, 1, 4, 1, 0], [0, 0, 1, 4, 1], [0, 0, 0, 1, 2]], float)
    y = np.array([0, 0, 1e3, 0, 0])
    slope = np.diff(y) / h
    m = np.linalg.solve(a, 6 / h * np.array([slope[0], *np.diff(slope), -slope[-1]]))
    integral = sum((y[k] + y[k + 1]) * h / 2 - (m[k] + m[k + 1]) * h**3 / 24 for k in range(4))
    assert v[-1, 0] == pytest.approx(integral, rel=1e-6)
    assert "f.fx: not smooth at t = 1 1.0004 s" in explain(gudgeon, text)


@pytest.mark.parametrize("beyond, momentum", [("hold", 25.5), ("linear", 25.5 + 30 * 2.4**2)])
def test_polynomial_that_ends(gudgeon, beyond, momentum):
    """1 N + 100 N/s^2 (t - 0.3 s)^2 up to 0.6 s, 1 N before: both ends are instants. 1.5 N.s to 0.6 s, then 10 N for 2.4 s."""
    head = f"[function.polynomial]\nname c0[N] c2[N/s^2] origin[s] end[s] beyond\nrise 1 100 0.3 0.6 {beyond}\n"
    text = deck("rise(t)").replace("[bodies]", head + "[bodies]", 1)
    _, _, v, _, _ = run(gudgeon, text)
    assert v[-1, 0] == pytest.approx(momentum, rel=1e-9)
    assert "f.fx: not smooth at t = 0.3 0.6 s" in explain(gudgeon, text)


def test_instants_of_a_sweep(gudgeon):
    """A pulse whose begin is swept: each case meets its own instants, as a single run does, however many run at once."""
    text = deck("10N*(step(t-begin)-step(t-begin-0.1s))", spring=SPRING)
    text = text.replace("[bodies]", "[parameters]\nbegin = 1 s\n[bodies]", 1)
    directory = scratch()
    sweep = text + "[statistics]\nafter = 1 ms\nperiod = 1 s\n[sweep]\nbegin = 0.75 1 1.3 s\nkeep = channels\n"
    call(gudgeon, "sweep", written(directory, sweep), "--out", directory / "o", "--jobs", "2")
    single = scratch()
    call(gudgeon, "run", written(single, text), "--set", "begin=1.3s", "--out", single / "o")
    with h5py.File(directory / "o" / "sweep.h5") as file, h5py.File(single / "o" / "run.h5") as one:
        for k, begin in enumerate((0.75, 1, 1.3)):
            group = file[f"channels/{k + 1}"]
            t, x = group["time"][:], group["bodies/position"][:].reshape(len(group["time"]), -1)
            expected = response(t, begin) - response(t, begin + 0.1)
            assert np.abs(x[:, 0] - 1 - expected).max() < 1e-6 * np.abs(expected).max()
        assert file["channels/3/bodies/position"][:].tobytes() == one["bodies/position"][:].tobytes()


WALL = """deck = 1
[bodies]
name mass[kg] inertia[kg.m^2] x[m] y[m] angle[rad]
ball 1 1 0 0 0
wall 1 1 -0.5 0 0
[points]
name body xi[m] eta[m]
o ground 0 0
b ball 0 0
w wall 0 0
[material]
name young[GPa] poisson
steel 207 0.3
[joint.translational]
name i j axis
jw o w x
[driver.position]
name i j axis position
push o w x {-0.5m+0.55m*exp(-((t-2s)/5e-3s)^2)}
[contact.exact]
name restitution
law 1
[clearance.plane]
name plane ball axis radius[m] law material ball_material
hit w b x 0.01 law steel steel
[analysis.dynamic]
end = 3 s
start = given
tolerance = 1e-9
[output]
every = 1 s
"""


@pytest.mark.parametrize("name", ["verner", "dop853", "adams", "bdf"])
def test_wall_that_comes_and_goes(gudgeon, name):
    """A wall is at the ball for some milliseconds of 3 s, between two output instants. The onset is that of the wall's motion."""
    *_, file = run(gudgeon, WALL, "--method", name)
    onset, speed = file["events"]["time"][0], file["events"]["impact_speed"][0]
    s = 5e-3 * np.sqrt(-np.log(0.49 / 0.55))
    assert onset == pytest.approx(2 - s, abs=1e-7)
    assert speed == pytest.approx(0.49 * 2 * s / 5e-3**2, rel=1e-5)


def test_drivers_that_bend(gudgeon):
    """A driven position with a kink in its acceleration: the motion is the driver's, in a dynamic and a kinematic analysis."""
    text = deck("0N").replace("[force.point]\nname point fx\nf c {0N}\n", "[driver.position]\nname i j axis position\n"
                              "d o c x {1m+1m/1s^2*max(0s,t-1.2345s)^2/2}\n")
    for analysis in ("dynamic", "kinematic"):
        again = text if analysis == "dynamic" else text.replace("analysis.dynamic", "analysis.kinematic").replace("start = given\n", "")
        t, x, v, _, _ = run(gudgeon, again)
        s = np.maximum(t - 1.2345, 0)
        assert np.abs(x[:, 0] - 1 - s**2 / 2).max() < 1e-9
        assert np.abs(v[:, 0] - s).max() < 1e-8


def test_maximum_step_of_the_deck_rules(gudgeon):
    """A greatest step of the deck takes the place of the pace; instants stay. Explain says which one is in force."""
    text = deck("1e3N*exp(-((t-1.2345s)/1e-4s)^2)", maximum_step="1 s")
    assert "(maximum_step)" in explain(gudgeon, text)
    assert "f.fx: maximum step" in explain(gudgeon, deck("1e3N*exp(-((t-1.2345s)/1e-4s)^2)"))
    assert "f.fx: not smooth at t = 1 1.1 s" in explain(gudgeon, deck("10N*(step(t-1s)-step(t-1.1s))"))
    assert "not smooth at 5999 times" in explain(gudgeon, deck("1N*abs(sin(2*pi*1000Hz*t))"))


def test_repeated_and_ideal_runs(gudgeon_debug):
    """With all checks: two runs are equal bit for bit, also with --ideal; no exception of the search stops one."""
    text = deck("10N*(step(t-1s)-step(t-1.1s))+1N*abs(sin(2*pi*20Hz*t))+1N*exp(-((t-2s)/1e-4s)^2)+1N/(1+1e6*(t/1s-2)^2)", spring=SPRING)
    _, first, *_ = run(gudgeon_debug, text)
    _, second, *_ = run(gudgeon_debug, text, "--ideal")
    assert np.array_equal(first, second)


STICK = """deck = 1
[scene]
gravity = 0 -10 m/s^2
[bodies]
name mass[kg] inertia[kg.m^2] x[m] y[m] angle[rad]
p 1 1e6 0 0.0099999 0
[points]
name body xi[m] eta[m]
o ground 0 0
c p 0 0
[material]
name young[GPa] poisson
steel 207 0.3
[contact.exact]
name restitution
law 0.5
[friction.coulomb]
name coefficient
fr 0.5
[clearance.plane]
name plane ball axis radius[m] material law friction
hit o c y 0.01 steel law fr
[force.point]
name point fx
f c {4N*min(1,t/0.5s)+3N*step(t-1s)}
[analysis.dynamic]
end = 2 s
start = given
overlap = preload
tolerance = 1e-9
[output]
every = 10 ms
"""


@pytest.mark.parametrize("name", ["verner", "dop853", "adams", "bdf"])
def test_load_that_tears_a_contact_loose(gudgeon, name):
    """4 N are held by friction of 5 N; 7 N from 1 s on are not: it slips from that instant, at 2 m/s^2."""
    *_, file = run(gudgeon, STICK, "--method", name)
    slips = [row["time"] for row in file["events"][:] if row["kind"].strip(b"\0") == b"slip"]
    assert slips == [pytest.approx(1, abs=1e-12)]
    assert at_instants(file, "bodies/velocity").reshape(201, -1)[-1, 0] == pytest.approx(2, rel=1e-6)


def test_law_of_the_stretch(gudgeon):
    """A stop as a law of the stretch is a function of the state: the step control meets it. Speed after it by energy."""
    spring = "[force.spring]\nname i j free_length[m] law\ns o c 1 {1e6N/m*max(0,x/1m-0.1)*1m}"
    text = deck("1N*step(0.2s-t)", spring=spring)
    t, x, v, summary, _ = run(gudgeon, text)
    # 0.2 m/s; the stop turns the speed round
    hit = 0.2 + (0.1 - 0.02) / 0.2
    half = np.pi / 1e3
    late = t > hit + half + 1e-3
    assert np.abs(v[late, 0] + 0.2).max() < 1e-7
    assert np.abs(x[late, 0] - 1.1 + 0.2 * (t[late] - hit - half)).max() < 1e-7
