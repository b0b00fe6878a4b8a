"""The largest Lyapunov exponent, by the tangent with its jumps at events and by a twin, and how long digits mean anything."""

import functools
import json
import math
import time

import h5py
import numpy as np
import pytest
from conftest import IS_SANITIZED, ROOT
from scipy.integrate import solve_ivp
from support import DECK, assert_close, call, changed, plain, plain_deck, scratch, text_of, written

EPS = 2.0**-52


def study(program, text, *options, **settings):
    """The summary of a comparison of one setting at one tolerance, its directory in `directory`."""
    keys = {"coarsest": "1e-6", "finest": "1e-6", "rounds": 1, "instants": 50, "budget": "0 s", "methods": "verner", **settings}
    text += "\n[precision]\n" + "".join(f"{key} = {value}\n" for key, value in keys.items())
    directory = scratch()
    call(program, "precision", written(directory, text), "--out", directory / "out", "--quiet", *options)
    summary = json.loads((directory / "out" / "summary.json").read_text())
    summary["directory"] = directory / "out"
    return summary


def run_with_horizon(program, text, *options, expect=0):
    """The summary of a run with --horizon, its directory in `directory`."""
    directory = scratch()
    done = call(program, "run", written(directory, text), "--out", directory / "out", "--quiet", "--horizon", *options, expect=expect)
    summary = json.loads((directory / "out" / "summary.json").read_text())
    summary["directory"] = directory / "out"
    summary["said"] = done.stderr
    return summary


def read(directory, path, name="run.h5"):
    """A dataset or, with @, an attribute of a file."""
    with h5py.File(directory / name) as file:
        if "@" in path:
            group, attribute = path.split("@")
            return plain(file[group].attrs[attribute])
        return plain(file[path][()])


def assert_same_exponents(summary):
    """Both methods are known and agree within their intervals."""
    assert summary["exponent_reason"] == summary["exponent_by_twin_reason"] == ""
    apart = abs(summary["exponent"] - summary["exponent_by_twin"])
    assert apart <= summary["exponent_interval"] + summary["exponent_by_twin_interval"]
    assert summary["exponents_agree"] is True


OSCILLATOR = """deck = 1
[bodies]
name mass[kg] inertia[kg.m^2] x[m] y[m]
mass 2        1               1.5  0
[points]
name   body   xi[m] eta[m]
wall   ground 0     0
centre mass   0     0
[joint.translational]
name i    j      axis
way  wall centre x
[force.spring]
name   i    j      stiffness[N/m] free_length[m] damping[N.s/m]
spring wall centre 50             1              {damping}
[analysis.dynamic]
end = {end} s
"""


@pytest.mark.parametrize("damping", [2.0, 0.4])
def test_damped_oscillator(gudgeon, damping):
    """Its exponent is -zeta omega = -c/(2 m), by both methods."""
    end = 40 / damping * 2
    summary = study(gudgeon, OSCILLATOR.format(damping=damping, end=end), exponent_instants=2000)
    assert_same_exponents(summary)
    rate = -damping / 4
    for name in ("exponent", "exponent_by_twin"):
        assert_close(summary[name], rate, absolute=summary[name + "_interval"], what=name)
        assert_close(summary[name], rate, relative=0.02, what=name)
    assert summary["exponent_jumps"] == 0
    assert "trajectories converge" in (summary["directory"] / "summary.txt").read_text()


PENDULUM = """deck = 1
[scene]
gravity = 0 -9.81 m/s^2
[bodies]
name mass[kg] inertia[kg.m^2]     x[m] y[m] angle[deg]
rod  1        0.08333333333333333 0    -0.5 -90
[points]
name body   xi[m] eta[m]
seat ground 0     0
hub  rod    -0.5  0
[joint.revolute]
name i    j
pin  seat hub
[force.torsion_spring]
name   i      j   stiffness[N.m/rad] damping[N.m.s/rad]
damper ground rod 0                  {damping}
[force.torque]
name  body moment
drive rod  {{{torque} N.m*cos({omega} rad/s*t)}}
[analysis.dynamic]
end = {end} s
"""


def pendulum_growth(damping, torque, omega, end, instants):
    """ln of the growth of a tangent of the driven pendulum, J theta'' = -m g l sin - c theta' + T cos, by scipy."""
    inertia, weight = 1 / 12 + 0.25, 9.81 * 0.5

    def rhs(t, y):
        return [y[1], (-weight * math.sin(y[0]) - damping * y[1] + torque * math.cos(omega * t)) / inertia,
                y[3], (-weight * math.cos(y[0]) * y[2] - damping * y[3]) / inertia]

    times = np.linspace(0, end, instants + 1)
    state, level, growth = np.array([0.0, 0.0, 0.6, 0.4]), 0.0, [0.0]
    for begin, until in zip(times, times[1:]):
        state = solve_ivp(rhs, (begin, until), state, rtol=1e-10, atol=1e-12, method="DOP853").y[:, -1]
        length = np.hypot(state[2], state[3] / 5)
        level += math.log(length)
        state[2:] /= length
        growth.append(level)
    return times, np.array(growth)


@pytest.mark.slow
def test_driven_pendulum(gudgeon):
    """Regular with a small torque, chaotic with a large one: as an integration of the variational equation by scipy has it."""
    omega = 2.557
    for torque, is_chaotic, end in ((1.5, False, 100), (7.36, True, 400)):
        text = PENDULUM.format(damping=0.6393, torque=torque, omega=omega, end=end)
        summary = study(gudgeon, text, exponent_instants=1600)
        assert_same_exponents(summary)
        times, growth = pendulum_growth(0.6393, torque, omega, end, 416)
        first = 104
        slopes = np.array([np.polyfit(t, g, 1)[0] for t, g in zip(np.split(times[first:-1], 8), np.split(growth[first:-1], 8))])
        rate, half = slopes.mean(), 2.365 * slopes.std(ddof=1) / math.sqrt(8)
        assert abs(summary["exponent"] - rate) <= summary["exponent_interval"] + half, torque
        if is_chaotic:
            assert summary["exponent"] - summary["exponent_interval"] > 0
            assert rate - half > 0
        else:
            assert_close(summary["exponent"], rate, relative=0.02, what="regular")
            assert rate < 0


def test_impacts_with_a_dashpot(gudgeon):
    """A driven mass that bounces on a spring with a dashpot: its force jumps by C u, S = [[1, 0], [-C/m, 1]] on (y, v) there.

    Without these matrices the exponent of this motion would be +1.4 instead of -0.4 1/s.
    """
    stiffness, restitution, torque, omega, spring, damping, rest, radius = 2e4, 0.5, 20.0, 12.0, 40.0, 0.5, 0.13, 0.1
    text = f"""deck = 1
[scene]
gravity = 0 -9.81 m/s^2
[bodies]
name mass[kg] inertia[kg.m^2] x[m] y[m]
ball 1        0.1             0    {rest}
[points]
name   body   xi[m] eta[m]
origin ground 0     0
hook   ground 0     {rest + 1}
centre ball   0     0
[joint.translational]
name i      j      axis
way  origin centre y
[force.spring]
name   i    j      stiffness[N/m] free_length[m] damping[N.s/m]
spring hook centre {spring}       1              {damping}
[force.point]
name  point  fy
drive centre {{{torque} N*cos({omega} rad/s*t)}}
[material]
name  young[GPa] poisson density[kg/m^3]
steel 207        0.3     7850
[clearance.plane]
name  plane  ball   axis radius[m] material law
floor origin centre y    {radius}  steel    stop
[contact.kelvin_voigt]
name stiffness[N/m] restitution     form
stop {stiffness}    {restitution}   dashpot
[analysis.dynamic]
end = 40 s
"""
    summary = study(gudgeon, text, exponent_instants=1600)
    assert_same_exponents(summary)
    zeta = -math.log(restitution) / math.hypot(math.pi, math.log(restitution))
    dashpot = 2 * zeta * math.sqrt(stiffness)

    def rhs(t, y, presses):
        force = stiffness * (radius - y[0]) - dashpot * y[1] if presses else 0.0
        k, c = (spring + stiffness, damping + dashpot) if presses else (spring, damping)
        return [y[1], -9.81 + torque * math.cos(omega * t) - spring * (y[0] - rest) - damping * y[1] + force,
                y[3], -k * y[2] - c * y[3]]

    def surface(t, y, presses):
        return y[0] - radius

    def pull(t, y, presses):
        return stiffness * (radius - y[0]) - dashpot * y[1]

    surface.terminal = pull.terminal = True
    pull.direction = -1
    t, y, level, impacts, touches, presses, marks = 0.0, np.array([rest, 0.0, 1.0, 0.0]), 0.0, 0, False, False, [(0.0, 0.0)]
    while t < 40:
        surface.direction = 1 if touches else -1
        events = [surface, pull] if presses else [surface]
        part = solve_ivp(rhs, (t, min(40, t + 0.2)), y, args=(presses,), events=events, rtol=1e-10, atol=1e-13, method="DOP853")
        t, y = part.t[-1], part.y[:, -1]
        if part.status == 1:
            if len(part.t_events[0]) and not touches:
                y[3] -= dashpot * y[2]  # the saltation
                touches = presses = True
                impacts += 1
            elif len(part.t_events[0]):
                touches = presses = False
            else:
                presses = False
        length = np.hypot(y[2], y[3] / 10)
        level += math.log(length)
        y[2:] /= length
        marks.append((t, level))
    marks = np.array(marks)
    rate = (marks[-1, 1] - np.interp(10, *marks.T)) / 30
    assert impacts > 100 and summary["exponent_jumps"] >= 2 * impacts - 1
    assert_close(summary["exponent"], rate, absolute=summary["exponent_interval"], what="with the jumps of the dashpot")
    assert_close(summary["exponent"], rate, absolute=0.05, what="with the jumps of the dashpot")
    assert_close(summary["exponent_by_twin"], rate, absolute=0.05, what="by a twin")


@functools.lru_cache(maxsize=None)
def slider_crank(program, clearance):
    """The slider-crank with a loose gudgeon pin, followed for twenty turns."""
    return study(program, plain_deck([("parameters", "c", clearance)]), exponent_end="240 ms", coarsest="1e-8", finest="1e-12",
                 per_decade=1, instants=200, methods='"verner adams"'.replace('"', ""))


def test_regular_slider_crank(gudgeon):
    """A hundredth of a millimetre: no exponential growth, all digits to the end."""
    summary = slider_crank(gudgeon, "0.01 mm")
    assert_same_exponents(summary)
    assert summary["exponent"] - summary["exponent_interval"] <= 0
    assert abs(summary["exponent"]) < 5  # of 83 turns in a second
    assert all(summary[f"horizon_{k}"] is None for k in range(1, 11))


def test_chaotic_slider_crank(gudgeon):
    """Half a millimetre: positive by both methods, the same, and what the first stretch of free twins shows."""
    summary = slider_crank(gudgeon, "0.5 mm")
    assert_same_exponents(summary)
    assert summary["exponent"] - summary["exponent_interval"] > 0
    assert summary["exponent_by_twin"] - summary["exponent_by_twin_interval"] > 0
    assert summary["growth"] == "exponential"
    assert abs(summary["exponent"] - summary["growth_rate"]) <= summary["exponent_interval"] + summary["growth_rate_interval"]
    growth = read(summary["directory"], "horizon/growth", "precision.h5")
    twin = read(summary["directory"], "horizon/growth_by_twin", "precision.h5")
    time = read(summary["directory"], "horizon/time", "precision.h5")
    early = (time > 0.012) & (time < 0.03)  # both along the same motion: instant by instant the same
    assert_close(np.diff(twin[early]), np.diff(growth[early]), absolute=0.03, what="growth")
    digits = read(summary["directory"], "horizon/digits", "precision.h5")
    known = digits[np.isfinite(digits)]
    assert len(known) == 12 and (np.diff(known) <= 0).all()
    assert (summary["directory"] / "figures" / "exponent.png").stat().st_size > 10000
    assert "chaotic" in (summary["directory"] / "summary.txt").read_text()


def rod_on_its_head(end):
    """A homogeneous rod of 1 m, upright on a pin at its lower end, at rest."""
    text = PENDULUM.format(damping=0, torque=0, omega=1, end=end)
    return text.replace("0    -0.5 -90", "0    0.5  90")


def test_run_with_horizon(gudgeon):
    """An unstable equilibrium grows by sqrt(3 g/(2 l)): exponent and digits in summary.txt, summary.json and run.h5."""
    rate = math.sqrt(1.5 * 9.81)
    summary = run_with_horizon(gudgeon, rod_on_its_head(6), "--tolerance", "1e-9")
    assert_close(summary["exponent"], rate, relative=1e-3)
    assert read(summary["directory"], "horizon@exponent") == summary["exponent"]
    time, growth = (read(summary["directory"], f"horizon/{name}") for name in ("time", "growth"))
    assert_close(np.polyfit(time[400:], growth[400:], 1)[0], rate, relative=1e-6, what="slope of the growth")
    step = time[1]
    for name, error in (("horizon", EPS), ("horizon_of_run", 1e-9)):
        for k in range(1, 13):
            first = growth + math.log(error) > -k * math.log(10)
            if not first.any():
                assert summary[f"{name}_{k}"] is None
            else:
                assert_close(summary[f"{name}_{k}"], max(0, time[first.argmax()] - step), absolute=1e-9, what=(name, k))
    latest, most = math.log(1e-8 / EPS) / rate, rate * 6 + 1  # rates are measured by 1/(6 s), so a change is most times the start's
    assert latest - math.log(most) / rate - step < summary["horizon_8"] < latest + step
    text = (summary["directory"] / "summary.txt").read_text()
    assert "exponent   3.83" in text and "digits of a run of tolerance 1e-9" in text
    assert "exponent_by_twin" not in summary


def test_horizon_changes_nothing_else(gudgeon):
    """The run itself is the same with and without it, and so are its files."""
    text = plain_deck([("analysis.dynamic", "end", "2 ms")])
    summary = run_with_horizon(gudgeon, text)
    directory = scratch()
    call(gudgeon, "run", written(directory, text), "--out", directory / "out", "--quiet")
    plain_summary = json.loads((directory / "out" / "summary.json").read_text())
    aside = ("created", "cpu_seconds", "wall_seconds", "seconds_per_rhs", "directory", "deck")
    for name, value in plain_summary.items():
        if name not in aside:
            assert summary[name] == value, name
    assert read(summary["directory"], "bodies/position").tobytes() == read(directory / "out", "bodies/position").tobytes()
    with h5py.File(directory / "out" / "run.h5") as file:
        assert "horizon" not in file


@pytest.mark.parametrize(
    "deck, options",
    [
        (DECK, ("--ideal",)),
        (DECK, ("--set", "c=0.1mm", "--method", "adams", "--json", "--write", "numbers")),
        (DECK, ("--set", "friction=0.1", "--method", "rk4")),
        (ROOT / "inputs" / "shaken_pendulum.deck", ("--member", "2")),
        (ROOT / "inputs" / "slider_crank_translational.deck", ("--method", "ida")),
        (ROOT / "inputs" / "billiards.deck", ()),
        (ROOT / "inputs" / "quick_return.deck", ()),
    ],
)
def test_horizon_beside_other_options(gudgeon_debug, deck, options):
    """Every way to run takes it too, in the build with run-time checks; what has no exponent says why."""
    text = changed(text_of(deck), "output", figures=None, every=None, last=None, **{"from": None})
    text = changed(text, "analysis.dynamic", end="1 ms")
    if "--member" in options:
        text += "\n[ensemble]\nruns = 3\nposition = 1 um\nvelocity = 1 mm/s\nseed = 1\n"
    if "--method" in options and "rk4" in options:
        text = changed(text, "analysis.dynamic", step="1 us")
    directory = scratch()
    done = call(gudgeon_debug, "run", written(directory, text + "\n[precision]\nexponent_instants = 32\n"), "--horizon",
                "--out", directory / "out", *options)
    summary = json.loads((directory / "out" / "summary.json").read_text())
    assert (summary["exponent_reason"] == "") == ("exponent" in summary)
    assert "exponent" in summary or "no coordinate is free" in summary["exponent_reason"]
    shown = json.loads(done.stdout) if "--json" in options else done.stdout
    assert "exponent" in shown


def test_where_it_is_refused(gudgeon):
    """Sweeps and analyses without a motion in time say so."""
    done = call(gudgeon, "sweep", ROOT / "inputs" / "studies" / "law_study.deck", "--horizon", expect=2)
    assert "unknown option '--horizon' of sweep" in done.stderr and "options of this verb: run" in done.stderr
    done = call(gudgeon, "run", ROOT / "inputs" / "four_bar_kinematic.deck", "--horizon", expect=2)
    assert "option --horizon needs [analysis.dynamic]" in done.stderr and "kinematic" in done.stderr


def held_body(inertia, damping, end):
    """A body in space that sixteen springs with dampers hold, four in each of four arms; at rest none is under tension."""
    arms = [((s * 0.2, 0, 0), "yz") for s in (1, -1)] + [((0, s * 0.2, 0), "xz") for s in (1, -1)]
    points, springs = ["name body xi[m] eta[m] zeta[m]"], ["name i j stiffness[N/m] free_length[m] damping[N.s/m]"]
    for place, axes in arms:
        for axis in axes:
            for side in (0.5, -0.5):
                far = [x + side * (axis == name) for x, name in zip(place, "xyz")]
                n = len(springs)
                points += [f"g{n} ground " + " ".join(map(str, far)), f"b{n} box " + " ".join(map(str, place))]
                springs.append(f"s{n} g{n} b{n} 40 0.5 {damping}")
    return "\n".join(
        ["deck = 1", "[scene]", "space = spatial", "gravity = 0 0 0 m/s^2", "[bodies]",
         "name mass[kg] ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2] x[m] y[m] z[m] vx[m/s] wx[rad/s] wy[rad/s] wz[rad/s]",
         "box 2 {} {} {} 0.002 0 0.001 0.02 0.1 0.1 0.05".format(*inertia), "[points]", *points, "[force.spring]", *springs,
         "[analysis.dynamic]", f"end = {end} s", ""]
    )


def test_damped_turns_in_space(gudgeon):
    """All six freedoms are damped, and the slowest to decay is the turn about y: -4 c a^2/(2 I_y).

    The length of Euler parameters, which no force feels, would decay at no time and make the exponent zero.
    """
    damping, inertia = 0.2, (0.15, 0.2, 0.3)
    rate = -4 * damping * 0.2**2 / (2 * inertia[1])
    summary = study(gudgeon, held_body(inertia, damping, 100), exponent_instants=2000)
    assert_same_exponents(summary)
    for name in ("exponent", "exponent_by_twin"):
        assert_close(summary[name], rate, absolute=summary[name + "_interval"], what=name)
        assert_close(summary[name], rate, relative=0.1, what=name)
    assert "trajectories converge" in (summary["directory"] / "summary.txt").read_text()


TUMBLING = """deck = 1
[scene]
space = spatial
gravity = 0 0 0 m/s^2
[bodies]
name mass[kg] ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2] wx[rad/s] wy[rad/s] wz[rad/s]
box  2        0.01        0.02         0.03       0.1       5         0.2
[points]
name body   xi[m]
o    ground 0
[force.torque]
name  body mx[N.m]
push  box  0
[analysis.dynamic]
end = 30 s
"""


def test_tumbling_is_regular(gudgeon):
    """A free body beside its middle axis turns over again and again, but its motion is known: neighbours part in proportion to time.

    Its distance from them swings in step with the batches of the exponent, whose own mean is 0.19 +-0.03 1/s; and it never leaves its place:
    only its orientation tells the twins apart.
    """
    summary = study(gudgeon, TUMBLING, coarsest="1e-10", finest="1e-12", per_decade=1, instants=200)
    assert_same_exponents(summary)
    assert summary["exponent"] - summary["exponent_interval"] <= 0 <= summary["exponent"] + summary["exponent_interval"]
    assert summary["growth"] == "power"
    assert_close(summary["growth_power"], 1, absolute=0.2, what="power of time")
    assert "no faster than a power of time" in (summary["directory"] / "summary.txt").read_text()


def test_time_that_ends_early(gudgeon):
    """A limit of processor time ends the search for the exponent, which is told up to there."""
    limit = "12 s" if IS_SANITIZED else "3 s"  # the sanitizers take most of it, and 64 of the 640 instants must be reached
    text = changed(changed(plain_deck([]), "analysis.dynamic", end="2 s", limit_cpu=limit), "output", every="1 ms", figures=None)
    summary = run_with_horizon(gudgeon, text, "--write", "numbers", expect=(0, 5))
    assert summary["exponent_cut"] is True and summary["exponent_reason"] == ""
    assert summary["exponent_to"] < 2 and summary["exponent_from"] == pytest.approx(0.25 * summary["exponent_to"])
    report = (summary["directory"] / "summary.txt").read_text()
    assert "time budget exhausted before the end" in report


@pytest.mark.parametrize("key", [False, True])
def test_the_horizon_keeps_its_budget(gudgeon, key):
    """Without a limit of the deck the search ends where its budget is up, given by --budget or by the section; the run does not."""
    budget = "12 s" if IS_SANITIZED else "3 s"
    text = changed(changed(plain_deck([]), "analysis.dynamic", end="4 s"), "output", every="1 ms", figures=None)
    text += f"\n[precision]\nbudget = {budget if key else '10 min'}\nexponent_instants = 8000\n"
    began = time.monotonic()
    summary = run_with_horizon(gudgeon, text, "--write", "numbers", *(() if key else ("--budget", budget)))
    assert time.monotonic() - began < 60
    assert summary["time_end"] == 4 and summary["status"] == "complete"
    assert summary["exponent_cut"] is True and 0 < summary["exponent_to"] < 4
    assert "time budget exhausted before the end of the motion: raise it with --budget" in (summary["directory"] / "summary.txt").read_text()
    short = run_with_horizon(gudgeon, text, "--write", "numbers", "--budget", "1 ms")
    assert "time budget exhausted" in short["exponent_reason"]


def test_a_run_that_goes_on_has_the_horizon_of_its_beginning(gudgeon):
    """Where the search ends is a matter of the clock: restarts take what the first run found, and a resumed run too."""
    text = changed(changed(plain_deck([]), "analysis.dynamic", end="60 ms"), "output", every="1 ms", figures=None)
    text += "\n[precision]\nexponent_instants = 4000\n"
    directory = scratch()
    deck = written(directory, text)
    options = ("--horizon", "--budget", "30 ms", "--write", "numbers")
    done = call(gudgeon, "run", deck, "--out", directory / "out", "--verify-restart", *options)
    assert "equal bit for bit after 3 restarts" in done.stdout
    summary = json.loads((directory / "out/summary.json").read_text())
    assert summary["exponent_cut"] is True or "time budget exhausted" in summary["exponent_reason"]
    # the search of a run that goes on would have eight times the time
    long = written(directory, changed(text, "analysis.dynamic", end="100 s", checkpoint="1 ms"), "long.deck")
    seen = []
    for more in (("--budget", "300 ms"), ("--budget", "2400 ms", "--resume")):
        call(gudgeon, "run", long, "--out", directory / "parts", "--horizon", "--walltime", "3 s", "--quiet", "--write", "numbers", *more, expect=7)
        with h5py.File(directory / "parts/run.h5") as file:
            seen.append((file["horizon/time"][-1], file["horizon/growth"][:].tobytes(), file["horizon"].attrs["exponent_reason"]))
    assert seen[0] == seen[1]
