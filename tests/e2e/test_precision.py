"""`gudgeon precision`: errors that fall with the tolerance, orders, the reference against closed forms, twins, the budget."""

import csv
import functools
import json
import math
import re
import time

import h5py
import numpy as np
import pytest
from conftest import ROOT
from support import DECK, SLOWNESS, Run, assert_close, call, changed, plain, plain_deck, scratch, text_of, written

HARD = ROOT / "inputs" / "hard"
EXPECTED_FILES = {"deck.echo", "figures", "precision.csv", "precision.h5", "precision.txt", "summary.json", "summary.txt"}


class Study:
    """What a comparison left behind."""

    def __init__(self, directory, done):
        self.directory = directory
        self.done = done
        self.summary = json.loads((directory / "summary.json").read_text())

    @functools.cached_property
    def rows(self):
        """precision.csv, numbers as such."""
        rows = list(csv.DictReader((self.directory / "precision.csv").open()))
        for row in rows:
            for key, value in row.items():
                if re.fullmatch(r"[-+.\dEe]+", value):
                    row[key] = float(value)
        return rows

    def ladder(self, setting):
        """The runs of a setting, from the coarsest on."""
        return [row for row in self.rows if row["setting"] == setting]

    def read(self, path):
        """A dataset or, with @, an attribute of precision.h5."""
        with h5py.File(self.directory / "precision.h5") as file:
            if "@" in path:
                group, name = path.split("@")
                return plain((file[group] if group else file).attrs[name])
            return plain(file[path][()])


def compared(program, text, *options, expect=0):
    """A comparison of settings of a deck's text."""
    directory = scratch()
    deck = written(directory, text)
    done = call(program, "precision", deck, "--out", directory / "out", "--quiet", *options, expect=expect)
    return Study(directory / "out", done)


def ladders(per_decade=1, **settings):
    """A section [precision], light unless said otherwise."""
    keys = {"coarsest": "1e-4", "finest": "1e-11", "per_decade": per_decade, "rounds": 1, "instants": 50, **settings}
    return "\n[precision]\n" + "".join(f"{key} = {value}\n" for key, value in keys.items())


def no_figures(text):
    """A deck without figures of its own and without a greatest step."""
    text = re.sub(r"(?m)^\s*figures\s*=.*\n", "", text)
    return re.sub(r"(?m)^\s*maximum_step\s*=.*\n", "", text)


REGULAR = {
    "pendulum": (HARD / "a01_simple_pendulum.deck", {"end": "2 s"}, ()),
    "andrews": (HARD / "a03_andrews_squeezer.deck", {"end": "10 ms"}, ()),
    "four-bar": (HARD / "a02_four_bars_1.deck", {"end": "0.3 s"}, ()),
    "slider-crank": (DECK, {"end": "12 ms"}, ("--ideal",)),
}


@functools.lru_cache(maxsize=None)
def regular(program, name):
    """The comparison of a regular motion."""
    deck, settings, options = REGULAR[name]
    text = changed(no_figures(text_of(deck)), "analysis.dynamic", **settings) + ladders(per_decade=2, budget="0 s")
    return compared(program, text, "--methods", "verner rk4 adams", *options)


@pytest.mark.parametrize("name", REGULAR)
def test_error_falls_with_the_tolerance(gudgeon, name):
    """From rung to rung on the whole, down to what the reference itself is not sure of, over at least four decades."""
    study = regular(gudgeon, name)
    bar = study.summary["reference_error"]
    assert 0 < bar < 1e-7
    for setting in ("verner", "rk4", "adams"):
        rows = [row for row in study.ladder(setting) if row["state"] == "done" and row["motion"] > 10 * bar]
        errors = np.array([row["motion"] for row in rows])
        assert len(errors) >= 4, setting
        assert errors[-1] < 1e-4 * errors[0], setting
        for k in range(len(errors) - 2):  # two rungs, a decade of tolerance, later it is less
            assert errors[k + 2] < errors[k], (setting, rows[k]["asked"])
        if setting != "adams":  # whose order changes as it likes
            steps = [row["steps"] for row in rows]
            assert steps == sorted(steps), setting


@pytest.mark.parametrize("name", REGULAR)
def test_observed_order(gudgeon, name):
    """rk4 is of order 4; what verner delivers is about in proportion to what is asked."""
    study = regular(gudgeon, name)
    orders = dict(zip(study.read("ladders/names"), study.read("ladders/order")))
    exponents = dict(zip(study.read("ladders/names"), study.read("ladders/exponent")))
    assert_close(orders["rk4"], 4, absolute=0.2, what="order of rk4")
    assert_close(exponents["verner"], 1, absolute=0.25, what="proportionality of verner")
    rows = [row for row in study.ladder("rk4") if row["state"] == "done" and 1e-9 < row["motion"] < 1e-4]
    slope = np.polyfit(np.log([row["asked"] for row in rows]), np.log([row["motion"] for row in rows]), 1)[0]
    assert_close(slope, 4, absolute=0.3, what="over the steps asked for")


def test_regular_motion_keeps_its_digits(gudgeon):
    """No exponential growth, and no horizon within the run; of one in which nothing is free, or whose start
    `[initial.speed]` holds, there are no twins."""
    for name in REGULAR:
        study = regular(gudgeon, name)
        assert study.summary["growth"] == ("" if name in ("four-bar", "slider-crank") else "power"), name
        assert study.summary["window"] == study.summary["end"], name
        assert np.isnan(study.read("twins/horizon")[:8]).all(), name


def test_all_that_is_written(gudgeon):
    """Files say the same; the choice is the cheapest that reaches the error wanted, and gives the same once more."""
    study = regular(gudgeon, "pendulum")
    assert {path.name for path in study.directory.iterdir()} >= EXPECTED_FILES
    assert {path.name for path in (study.directory / "figures").glob("*.png")} == {"precision.png", "precision_views.png", "horizon.png", "exponent.png"}
    names = list(study.read("errors/names"))
    errors = study.read("runs/error")
    assert_close(errors[:, names.index("motion")], [row["motion"] for row in study.rows], relative=1e-15)
    assert_close(study.read("runs/steps"), [row["steps"] for row in study.rows])
    assert_close(study.read("runs/cpu"), [row["cpu [s]"] for row in study.rows], relative=1e-15)
    good = [row for row in study.rows if row["state"] == "done" and row["motion"] <= study.summary["accuracy"]]
    safe = [row for row in good if all(
        other in good for other in study.ladder(row["setting"]) if other["state"] == "done" and other["asked"] < row["asked"])]
    best = min(safe, key=lambda row: row["cpu [s]"])
    assert study.read("choice@setting") == best["setting"]
    assert study.read("choice@asked") == best["asked"]
    assert study.summary["confirmed_error"] == best["motion"]
    front = [row for row in study.rows if row["front"] == 1]
    for one in front:
        for other in good:
            assert not (other["cpu [s]"] < one["cpu [s]"] and other["motion"] < one["motion"] and one["below"] == 0)
    assert study.read("@filetype") == "gudgeon precision"
    for name in ("machine", "compiler", "compile_flags"):
        assert len(study.read(f"@{name}")) > 3
    text = (study.directory / "summary.txt").read_text()
    assert "confirmed by" in text and "choice     method = " in text and study.summary["choice"] in text


def test_timed_runs_are_the_runs_compared(gudgeon):
    """Costs of the solution do not hang on what is kept: a run by itself makes the same steps and evaluations."""
    study = regular(gudgeon, "pendulum")
    deck, settings, _ = REGULAR["pendulum"]
    row = next(row for row in study.ladder("verner") if abs(row["asked"] / 1e-8 - 1) < 1e-9)
    text = changed(no_figures(text_of(deck)), "analysis.dynamic", **settings)
    directory = scratch()
    call(gudgeon, "run", written(directory, text), "--out", directory / "out", "--tolerance", "1e-8", "--method", "verner", "--quiet")
    summary = Run(directory / "out").summary
    assert row["steps"] == summary["steps"]
    assert row["rhs"] == summary["rhs_evaluations"] - summary["output_evaluations"]


CLOSED = {
    "oscillator": (
        """[bodies]
name mass[kg] inertia[kg.m^2] x[m] y[m]
mass 2        1               1.5  0
[points]
name   body   xi[m] eta[m]
wall   ground 0     0
centre mass   0     0
[force.spring]
name   i    j      stiffness[N/m] free_length[m]
spring wall centre 50             1
""",
        lambda t: (1 + 0.5 * np.cos(5 * t), -2.5 * np.sin(5 * t), 0 * t, 0 * t),
    ),
    "free fall": (
        """[scene]
gravity = 0 -9.81 m/s^2
[bodies]
name mass[kg] inertia[kg.m^2] x[m] y[m] vx[m/s] vy[m/s]
mass 2        1               0    3    1       2
""",
        lambda t: (t, 1 + 0 * t, 3 + 2 * t - 4.905 * t**2, 2 - 9.81 * t),
    ),
}


@pytest.mark.parametrize("name", CLOSED)
def test_the_reference_is_right_within_its_error_bar(gudgeon, name):
    """Its own trajectory, run by itself at the same instants, against the closed form, in the scales of the comparison."""
    scene, solution = CLOSED[name]
    text = "deck = 1\n" + scene + "[analysis.dynamic]\nend = 4 s\n[output]\nevery = 40 ms\n"
    study = compared(gudgeon, text + ladders(instants=100), "--methods", "verner adams rk4")
    method, tolerance = study.summary["reference"].split()
    directory = scratch()
    call(gudgeon, "run", written(directory, text), "--out", directory / "out", "--method", method, "--tolerance", tolerance)
    run = Run(directory / "out")
    position, velocity = run.item("bodies/position", "mass"), run.item("bodies/velocity", "mass")
    x, vx, y, vy = solution(run.time)
    size = max(np.ptp(x), np.ptp(y))
    speed = max(abs(vx).max(), abs(vy).max())
    bar = study.read("reference/error")
    spacing = 4e-15  # of numbers of the size of the coordinates, over the scales
    assert max(abs(position[:, 0] - x).max(), abs(position[:, 1] - y).max()) / size <= bar[1] + spacing
    assert max(abs(velocity[:, 0] - vx).max(), abs(velocity[:, 1] - vy).max()) / speed <= bar[2] + spacing
    assert bar[0] < 1e-8
    assert study.summary["confirmed_by"].split()[0] != method


def rod(angle, end, settings=""):
    """A rod on a pin at one end, 1 m long, homogeneous; its angle from the horizontal."""
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    return f"""deck = 1
[scene]
gravity = 0 -9.81 m/s^2
[bodies]
name mass[kg] inertia[kg.m^2]    x[m]         y[m]         angle[deg]
rod  1        0.08333333333333333 {c / 2:.17g} {s / 2:.17g} {angle}
[points]
name body   xi[m] eta[m]
seat ground 0     0
hub  rod    -0.5  0
[joint.revolute]
name i    j
pin  seat hub
[analysis.dynamic]
end = {end}
{settings}"""


def assert_room_in_the_figure(figures, digits):
    """Numbers of digits stand above the growth, none upon another, and the axis of the exponent holds all of its curves."""
    script = (figures / "exponent.gp").read_text(encoding="utf-8")
    tics = re.findall(r"'(\d+)' ([-+.E\d]+)", re.search(r"set x2tics \((.*?)\)", script)[1])
    assert [int(number) for number, _ in tics] == list(digits)
    places = np.array([float(at) for _, at in tics])[::-1]
    width = float(re.search(r"set x2range \[0:([-+.E\d]+)\]", script)[1])
    assert np.diff(places).min() > 0.0259 * width and places[-1] <= width
    assert re.findall(r"set label '(.*?)' at first \S+, graph (\S+)", script) == [("digits", "1")], "nothing over the curves"
    low, high = map(float, re.search(r"set yrange \[([-+.E\d]+):([-+.E\d]+)\]", script).groups())
    rates = np.loadtxt(figures / "exponent.dat")[:, 3:]
    assert low < np.nanmin(rates) and np.nanmax(rates) < high


def test_growth_at_an_unstable_equilibrium(gudgeon):
    """A rod on its head: neighbouring motions part as exp(sqrt(3 g/(2 l)) t); hanging down they stay together."""
    study = compared(gudgeon, rod(90, "4.5 s") + ladders(instants=200), "--methods", "verner adams")
    rate = math.sqrt(1.5 * 9.81)
    assert study.summary["growth"] == "exponential"
    assert_close(study.summary["growth_rate"], rate, relative=1e-3, what="rate")
    assert_close(study.read("twins@rate"), rate, absolute=max(study.read("twins@rate_interval"), 1e-4))
    horizon = study.read("twins/horizon")
    most = 0.5 * (rate * 4.5 + 1)  # at rest, velocities are measured by 1 m in 4.5 s: of x + v/rate = 1 m at most so much
    for k in (10, 11, 12):
        latest = math.log(10.0**-k / 2.22e-16) / rate + 0.05
        earliest = math.log(10.0**-k / 2.22e-16 / most) / rate - 0.05
        assert earliest < horizon[k - 1] < latest, k
    assert_room_in_the_figure(study.directory / "figures", range(8, 13))
    hanging = compared(gudgeon, rod(-60, "4.5 s") + ladders(instants=200), "--methods", "verner adams")
    assert hanging.summary["growth"] == "power"
    assert np.isnan(hanging.read("twins/horizon")).all()


def test_errors_are_told_inside_the_horizon_only(gudgeon):
    """A slider-crank with impacts: compared as long as the reference is known to a tenth of the error wanted, and no longer."""
    text = plain_deck([("analysis.dynamic", "end", "28 ms")])
    study = compared(gudgeon, text + ladders(coarsest="1e-6", finest="1e-12", instants=200), "--methods", "verner adams")
    assert study.summary["growth"] == "exponential"
    assert 0 < study.summary["window"] < study.summary["end"]
    assert study.summary["reference_error"] <= 0.1 * study.summary["accuracy"]
    times = study.read("twins/horizon")
    known = times[np.isfinite(times)]
    assert len(known) >= 3 and (np.diff(known) <= 0).all()
    agreed = study.read("reference/agrees_until")
    assert (np.diff(agreed) <= 0).all() and (times[np.isfinite(times)] >= agreed[np.isfinite(times)]).all()
    last = study.ladder("verner")[-1]
    assert last["onsets [s]"] < 1e-7 and last["peaks"] < 1e-3 and last["restitution"] < 1e-3
    assert last["onsets [s]"] >= 0
    check_statistics(study)


def test_settings_tell_the_same_statistics(gudgeon):
    """Over some fourteen turns beyond what is compared. A few turns have too few contacts for their intervals to be trusted. One run in
    twenty is apart by chance, and all of them from one reference, which may be the odd one: most of seven are not."""
    text = plain_deck([("analysis.dynamic", "end", "180 ms")])
    study = compared(gudgeon, text + ladders(coarsest="1e-6", finest="1e-12", instants=200), "--methods", "verner adams")
    for name in study.read("statistics/names"):
        assert study.summary[name + "_apart"] <= 3, name


def check_statistics(study):
    """Beyond what is compared, statistics with intervals take over: in the tables, the file, the figure and the words."""
    assert study.read("statistics@from") == study.summary["statistics_from"] == study.summary["window"]
    names = list(study.read("statistics/names"))
    reference = dict(zip(names, zip(study.read("statistics/reference")[0], study.read("statistics/reference_interval")[0])))
    own = study.read("statistics/is_own") == 1
    assert 0 < own.sum() < len(own) and not own[[row["asked"] for row in study.rows].index(1e-12)]
    counted = study.read("runs/ladder")
    # what is left beyond what is compared may have too few contacts for an interval of some
    assert sum(half > 0 for _, half in reference.values()) >= 3
    for place, name in enumerate(names):
        value, half = reference[name]
        told = study.summary[name + "_interval"]
        assert study.summary[name] == value and (told == half if half > 0 else told is None and np.isnan(half))
        values, halves = study.read("statistics/values")[:, place], study.read("statistics/intervals")[:, place]
        apart = own & (abs(values - value) > np.hypot(half, halves))
        for setting in (1, 2):
            chosen = own & (counted == setting) & np.isfinite(values)
            assert study.read("statistics/runs")[setting - 1, place] == chosen.sum()
            assert study.read("statistics/apart")[setting - 1, place] == (apart & chosen).sum()
            assert_close(study.read("statistics/settings")[setting - 1, place], values[chosen].mean(), 1e-12)
        assert study.summary[name + "_apart"] == apart.sum()
        column = next(key for key in study.rows[0] if key.startswith(name + " ["))
        assert [row[column] == "" for row in study.rows] == list(np.isnan(values))
        assert_close([row[column] for row in study.rows if row[column] != ""], list(values[np.isfinite(values)]), 1e-15)
    assert (study.directory / "figures" / "precision_statistics.png").stat().st_size > 10_000
    assert "diverged from it" in (study.directory / "summary.txt").read_text()


def test_another_sequence_of_contacts_is_a_flag(gudgeon):
    """A coarse run of a chaotic motion meets other contacts: no error of so many per cent, but a state of its own."""
    text = plain_deck([("analysis.dynamic", "end", "12 ms")])
    study = compared(gudgeon, text + ladders(coarsest="1e-2", finest="1e-10"), "--methods", "verner adams")
    other = [row for row in study.rows if row["state"] == "different contact sequence"]
    assert other
    for row in other:
        assert row["onsets [s]"] == row["peaks"] == row["restitution"] == ""
        assert row["front"] == 0
    assert study.summary["other_sequence"] == len(other)


def test_failures_stand_in_the_tables_with_their_reason(gudgeon):
    """What cannot be, what fails, and what there was no time for: all of them are told, none is left out."""
    text = no_figures(text_of(HARD / "a01_simple_pendulum.deck"))
    text = changed(text, "analysis.dynamic", end="1 s", contact_onset="reject") + ladders(finest="1e-6")
    study = compared(gudgeon, text, "--methods", "verner adams rk4.baumgarte_step verner.*.schur")
    adams = study.ladder("adams")
    assert len(adams) == 3
    assert {row["state"] for row in adams} == {"failed"}
    assert all("needs a one-step method" in row["reason"] for row in adams)
    assert study.summary["failed"] >= 3
    assert study.summary["runs"] + study.summary["failed"] + study.summary["not_run"] + study.summary["other_sequence"] == len(study.rows)
    summary = (study.directory / "summary.txt").read_text()
    assert "failed: adams 1.0e-4 to 1.0e-6 (3 runs): 'contact_onset = reject' needs a one-step method" in summary.replace("e-0", "e-")
    script = (study.directory / "figures" / "precision.gp").read_text()
    assert "adams failed: " in script


def test_nothing_is_chosen_without_a_confirmed_reference(gudgeon):
    """Where no other integrator runs to the end the error of the reference is not known, and no advice is given."""
    text = no_figures(text_of(HARD / "a01_simple_pendulum.deck"))
    text = changed(text, "analysis.dynamic", end="1 s", contact_onset="reject") + ladders(finest="1e-6")
    study = compared(gudgeon, text, "--methods", "verner")
    assert study.summary["confirmed_by"] == "" and study.summary["reference_error"] is None
    assert "choice" not in study.summary
    assert "none: no confirmed reference" in (study.directory / "summary.txt").read_text()


@pytest.mark.parametrize("seconds", [2 * SLOWNESS, 4 * SLOWNESS])
def test_the_budget_is_kept(gudgeon, seconds):
    """A comparison that would take minutes ends in time: the budget and the start and end of a process."""
    text = plain_deck([("analysis.dynamic", "end", "240 ms")])
    begin = time.perf_counter()
    study = compared(gudgeon, text, "--budget", f"{seconds}s")
    assert time.perf_counter() - begin < 1.25 * seconds + 2
    assert study.summary["budget"] == seconds
    assert study.summary["spent"] < seconds
    assert study.summary["not_run"] > 0
    assert all(row["reason"] == "time budget exhausted" for row in study.rows if row["state"] == "not run")


def test_slow_ladders_leave_time_for_others(gudgeon):
    """A stiff film: explicit methods get nowhere in this time, and leave enough for those that do."""
    text = no_figures(changed(text_of(ROOT / "inputs" / "journal_bearing.deck"), "parameters", duration="12 s"))
    study = compared(gudgeon, text, "--methods", "verner dop853 adams bdf ida", "--budget", f"{max(8, 4 * SLOWNESS)}s")
    assert study.summary["confirmed_by"]
    assert all(any(row["state"] == "done" for row in study.ladder(name)) for name in ("bdf", "ida"))
    assert not any(row["state"] == "done" for name in ("verner", "adams") for row in study.ladder(name))


def precession(t, moments, spin):
    """Rotation of a body with i_x = i_y on which nothing acts: about its angular momentum, after one about its axis."""

    def turn(axis, angle):
        axis = np.asarray(axis)/np.linalg.norm(axis)
        cross = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
        return np.eye(3) + math.sin(angle)*cross + (1 - math.cos(angle))*cross @ cross

    momentum = np.array(moments)*np.array(spin)
    about_axis = spin[2]*(1 - moments[2]/moments[0])
    return turn(momentum, np.linalg.norm(momentum)/moments[0]*t) @ turn([0, 0, 1], about_axis*t)


def rotation(p):
    """Rotation matrix of Euler parameters."""
    w, x, y, z = p
    return np.array([[1 - 2*(y*y + z*z), 2*(x*y - w*z), 2*(x*z + w*y)], [2*(x*y + w*z), 1 - 2*(x*x + z*z), 2*(y*z - w*x)],
                     [2*(x*z - w*y), 2*(y*z + w*x), 1 - 2*(x*x + y*y)]])


def test_orientation_in_space_is_a_position(gudgeon):
    """A top that turns on the spot: its errors of position are those of its orientation, by a closed form."""
    moments, spin, end = (0.02, 0.02, 0.03), (1.5, 0.0, 4.0), 6.0
    text = f"""deck = 1
[scene]
space = spatial
gravity = 0 0 0 m/s^2
[bodies]
name mass[kg] ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2] wx[rad/s] wy[rad/s] wz[rad/s]
top  2        {moments[0]} {moments[1]} {moments[2]} {spin[0]} {spin[1]} {spin[2]}
[analysis.dynamic]
end = {end} s
[output]
every = {end/200} s
"""
    study = compared(gudgeon, text + ladders(1, coarsest="1e-4", finest="1e-8", instants=200), "--methods", "verner")
    for row in study.ladder("verner")[:3]:
        directory = scratch()
        call(gudgeon, "run", written(directory, text), "--tolerance", repr(row["asked"]), "--out", directory / "out", "--quiet")
        run = Run(directory / "out", None)
        truth = np.array([precession(t, moments, spin) for t in run.time])
        error = np.abs(np.array([rotation(p) for p in run.item("bodies/orientation", "top")]) - truth).max()
        assert_close(row["positions"], error/np.ptp(truth, axis=0).max(), relative=1e-3, what=row["asked"])


def test_nothing_runs_to_its_end(gudgeon):
    """Then there is no reference, and the exit code says so; the reasons are in the tables."""
    text = no_figures(text_of(HARD / "a01_simple_pendulum.deck"))
    text = changed(text, "analysis.dynamic", maximum_steps="3") + ladders()
    study = compared(gudgeon, text, "--methods", "verner", expect=5)
    assert "no run was completed" in study.done.stderr
    assert study.summary["reference"] == ""
    assert (study.directory / "precision.txt").read_text().count("  failed") == len(study.rows)


@pytest.mark.parametrize(
    "options, words",
    [
        (("--methods", "vernor"), "did you mean 'verner'?"),
        (("--methods", "verner.projektion"), "did you mean 'projection'?"),
        (("--methods", ""), "needs settings"),
        (("--budget", "60"), "needs a time above zero with its unit"),
        (("--budget", "60 kg"), "needs a time above zero with its unit"),
        (("--budget", "-1s"), "needs a time above zero with its unit"),
        (("--accuracy", "0"), "needs a number from"),
        (("--accuracy", "few"), "needs a number from"),
        (("--tolerance", "1e-6"), "unknown option"),
    ],
)
def test_mistakes_of_the_command_line(gudgeon, options, words):
    done = call(gudgeon, "precision", DECK, *options, expect=2)
    assert words in done.stderr


def test_only_motions_are_compared(gudgeon):
    done = call(gudgeon, "precision", ROOT / "inputs" / "four_bar_kinematic.deck", expect=2)
    assert "[analysis.dynamic]" in done.stderr


def test_the_section_is_echoed(gudgeon):
    """The deck as understood means the same comparison."""
    study = compared(gudgeon, rod(-60, "1 s") + ladders(methods="rk4 verner.projection.schur", accuracy="1e-4"))
    echo = (study.directory / "deck.echo").read_text()
    assert "[precision]" in echo
    again = compared(gudgeon, echo)
    assert {row["setting"] for row in again.rows} == {"rk4", "verner.projection.schur"}
    assert again.summary["accuracy"] == 1e-4
    assert [row["steps"] for row in again.rows] == [row["steps"] for row in study.rows]


def test_auto_takes_the_place_of_the_decks_own_way(gudgeon):
    """`auto` is a word as any: what is chosen for the scene, here projection, not the deck's gains."""
    four_bar = (HARD / "a02_four_bars_1.deck").read_text()
    deck = changed(four_bar, "analysis.dynamic", end="1 s", stabilise="baumgarte alpha=5s^-1 beta=5s^-1") + ladders()
    study = compared(gudgeon, deck, "--methods", "verner verner.projection verner.auto verner.auto.auto")

    def told(setting):
        return [(row["steps"], row["rhs"], row["violation [m]"]) for row in study.ladder(setting)]

    assert told("verner.auto") == told("verner.projection") == told("verner.auto.auto")
    assert told("verner")[0][2] > 1e3 * told("verner.auto")[0][2]


def test_with_run_time_checks(gudgeon_debug):
    """All methods, ways and solvers of a short motion with impacts, in the build with run-time checks."""
    text = plain_deck([("analysis.dynamic", "end", "2 ms")]) + ladders(finest="1e-6", step_decades=1)
    study = compared(gudgeon_debug, text, "--methods", "* verner.* verner.projection.*")
    assert study.summary["settings"] == 8 + 7 + 5
    assert study.summary["runs"] > 20


@pytest.mark.parametrize("name, verb, options", [("pinball", "precision", ("--methods", "verner", "--budget", f"{4 * SLOWNESS}s")),
                                                 ("crosshead", "run", ("--accuracy", "1e-3", "--budget", "8s", "--write", "numbers"))])
def test_values_that_are_not_kept_are_not_found(gudgeon_debug, name, verb, options):
    """The other side of a stop has no normal, and some items have not all channels: with run-time checks nothing of that is worked out."""
    directory = scratch()
    call(gudgeon_debug, verb, ROOT / "inputs" / f"{name}.deck", "--out", directory / "out", "--quiet", *options, expect=(0, 6))
