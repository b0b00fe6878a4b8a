"""`gudgeon run --accuracy`: intervals against closed forms and tight runs, the horizon, what is not reached, what goes together."""

import csv
import math
import re
import sys
from itertools import pairwise

import h5py
import numpy as np
import pytest
from conftest import ROOT
from support import DECK, SLOWNESS, Run, assert_close, call, changed, plain, plain_deck, scratch, written

sys.path.insert(0, str(ROOT / "tests" / "accuracy"))
from certify import certify, has_failed  # noqa: E402
from random_decks import GRAVITY, POINTS, make, table  # noqa: E402

K, M, X_0, V_0 = 200.0, 2.0, 0.3, 0.7  # [N/m], [kg], [m], [m/s]
OMEGA = math.sqrt(K/M)
END = 2.0
SPRING = (
    "deck = 1\n[scene]\ngravity = 0 0 m/s^2\n"
    + table("bodies", "name mass[kg] inertia[kg.m^2] x[m] y[m] angle[rad] vx[m/s]", [("mass", M, 0.01, X_0, 0, 0, V_0)])
    + table("points", POINTS, [("line", "ground", 0, 0), ("slide", "mass", 0, 0), ("hook", "ground", -1, 0)])
    + table("joint.translational", "name i j axis", [("guide", "line", "slide", "x")])
    + table("force.spring", "name i j stiffness[N/m] free_length[m]", [("coil", "hook", "slide", K, 1)])
    + f"[analysis.dynamic]\nend = {END} s\n[output]\nevery = 1 ms\n"
)
ENSEMBLE = "[ensemble]\nruns = 3\nposition = 1 mm\nvelocity = 0 m/s\n"


def accurate(program, text, *options, expect=0):
    """Run a deck's text with options, everything written but text files."""
    directory = scratch()
    done = call(program, "run", written(directory, text), "--out", directory / "out", "--write", "channels", *options, expect=expect)
    return Run(directory / "out", done)


def extremes(run):
    """What the summary says of the channels, by name."""
    return {row["name"]: row for row in run.summary["accuracy"]["extremes"]}


def true_motion(t):
    """Position and velocity of the mass on the spring."""
    return (X_0*np.cos(OMEGA*t) + V_0/OMEGA*np.sin(OMEGA*t), -X_0*OMEGA*np.sin(OMEGA*t) + V_0*np.cos(OMEGA*t))


def test_joints_of_several_kinds(gudgeon_debug):
    """Channels that only some joints have are no numbers elsewhere, which the build with run-time checks must not compare."""
    text = changed((ROOT / "inputs" / "four_bar_spatial.deck").read_text(), "analysis.dynamic", end="5 ms")
    run = accurate(gudgeon_debug, changed(text, "output", every="1 ms", figures=None), "--accuracy", "1e-3", "--budget", "60s")
    assert run.summary["accuracy"]["error"] <= 1e-3


@pytest.mark.parametrize("accuracy", ["1e-2", "1e-5", "1e-8", "3e-11"])
def test_interval_holds_the_closed_form(gudgeon, accuracy):
    """Every value and both extremes of position and velocity are within the error claimed, and that within the accuracy."""
    run = accurate(gudgeon, SPRING, "--accuracy", accuracy, "--quiet")
    found = run.summary["accuracy"]
    assert found["claim"] == "end" and found["claimed_until"] == END and found["error"] <= float(accuracy)
    swing = math.hypot(X_0, V_0/OMEGA)  # reached several times on both sides, between output instants
    for quantity, truth, top in zip(("position", "velocity"), true_motion(run.time), (swing, OMEGA*swing)):
        row = extremes(run)[f"mass.{quantity}.x"]
        assert row["error"] <= float(accuracy)*row["scale"]
        scale = np.ptp(truth) if quantity == "position" else top
        assert abs(row["scale"] - scale) <= 2.0*float(accuracy)*scale
        error = np.abs(run.item(f"bodies/{quantity}", "mass")[:, 0] - truth).max()
        assert error <= row["error"], f"{quantity}: {error:.2e} is outside of {row['error']:.2e}"
        assert abs(row["min"] + top) <= row["error"] and abs(row["max"] - top) <= row["error"]


def test_finer_accuracy_takes_a_finer_tolerance(gudgeon):
    runs = [accurate(gudgeon, SPRING, "--accuracy", x, "--quiet").summary for x in ("1e-3", "1e-6", "1e-9")]
    tolerances = [summary["tolerance"] for summary in runs]
    assert tolerances[0] > tolerances[1] > tolerances[2]
    assert runs[0]["steps"] < runs[2]["steps"]


def test_beyond_round_off_is_told(gudgeon):
    """An accuracy that no run in double precision has: the exit code says so, and what was reached holds the closed form."""
    run = accurate(gudgeon, SPRING, "--accuracy", "1e-14", expect=6)
    found = run.summary["accuracy"]
    assert found["claim"] == "reached" and 1e-14 < found["error"] < 1e-9
    assert re.search(r"error: accuracy 1e-14 was requested, reached \S+: ", run.done.stderr)
    assert "not reached; error" in run.done.stdout
    row = extremes(run)["mass.position.x"]
    assert np.abs(run.item("bodies/position", "mass")[:, 0] - true_motion(run.time)[0]).max() <= row["error"]


def test_run_is_that_of_its_tolerance(gudgeon):
    """What is written is bit for bit the run with --tolerance, impacts and all; without --accuracy there is no group of it."""
    text = plain_deck([("analysis.dynamic", "end", "1 ms")])
    run = accurate(gudgeon, text, "--accuracy", "1e-5", "--quiet")
    again = accurate(gudgeon, text, "--tolerance", repr(run.summary["tolerance"]), "--quiet")
    assert "accuracy" not in again.summary
    with h5py.File(run.directory / "run.h5") as a, h5py.File(again.directory / "run.h5") as b:
        paths = []
        b.visititems(lambda name, node: paths.append(name) if isinstance(node, h5py.Dataset) else None)
        assert "accuracy" in a and "accuracy" not in b and len(paths) > 20
        for path in paths:
            if path.startswith("provenance/"):
                continue
            assert np.asarray(plain(a[path][()])).tobytes() == np.asarray(plain(b[path][()])).tobytes(), path


def test_extremes_are_those_of_the_rows(gudgeon):
    """Those of the run, located at contacts too; the file and both summaries say the same."""
    run = accurate(gudgeon, plain_deck([("analysis.dynamic", "end", "1 ms"), ("output", "channels", "slider.velocity gudgeon.normal_force")]),
                   "--accuracy", "1e-5")
    found = extremes(run)
    assert set(found) == {"slider.velocity.x", "slider.velocity.y", "gudgeon.normal_force"}
    velocity = run.item("bodies/velocity", "slider")[:, 0]
    assert found["slider.velocity.x"]["min"] == velocity.min() and found["slider.velocity.x"]["max"] == velocity.max()
    assert_close(found["gudgeon.normal_force"]["max"], run.contacts["peak_force"].max(), relative=1e-12, what="greatest force")
    for key in ("scale", "error", "min", "max"):
        assert list(run.read(f"accuracy/{key}")) == [row[key] for row in found.values()]
    assert list(run.read("accuracy/names")) == list(found)
    head, line = next(pair for pair in pairwise(run.done.stdout.splitlines()) if "slider.velocity.x [m/s]" in pair[1])
    assert head.split() == ["extremes", "with", "intervals", "min", "max", "+-"]  # the table of the accuracy comes first
    assert_close(float(line.split()[2]), velocity.min(), relative=1e-9, what=line)


def test_horizon_is_told_not_claimed(gudgeon):
    """Two joints that rattle: the accuracy up to a time, nothing beyond, and why; the run is none the worse."""
    run = accurate(gudgeon, (ROOT / "inputs" / "slider_crank_two_joints.deck").read_text(), "--accuracy", "1e-6", "--write", "numbers")
    found = run.summary["accuracy"]
    assert found["claim"] == "horizon" and 0.0 < found["claimed_until"] < run.summary["time_end"]
    assert found["error"] <= 1e-6 and found["error_at_end"] > 1e-2
    assert re.search(r"beyond t = \S+ s the solution is not predictable: runs diverge there, first in \S+", run.done.stdout)
    assert "neighbouring trajectories diverge as exp(" in run.done.stdout
    assert "have different contacts" in run.done.stdout and found["other_contacts_from"] > found["claimed_until"]


def test_small_budget_is_told(gudgeon):
    """Enough for some runs: the run is written, and the exit code says that it lacks what was asked for. Enough for none: an error."""
    text = (ROOT / "inputs" / "four_bar.deck").read_text()
    run = accurate(gudgeon, text, "--accuracy", "1e-9", "--budget", f"{max(2, SLOWNESS // 3)}s", "--write", "numbers", expect=6)
    assert run.summary["accuracy"]["claim"] in ("none", "reached") and run.summary["status"] == "complete"
    assert "time budget exhausted" in run.done.stderr
    none = accurate(gudgeon, text, "--accuracy", "1e-9", "--budget", "1ms", expect=5)
    assert "no run was completed: time budget exhausted" in none.done.stderr


@pytest.mark.slow
def test_time_is_kept_for_what_confirms(gudgeon):
    """A motion in space whose runs take long, and others' still longer: something is claimed within the budget all the same."""
    text = changed((ROOT / "inputs" / "double_pendulum.deck").read_text(), "output", figures=None)
    for budget in (6 * SLOWNESS, 12 * SLOWNESS, 24 * SLOWNESS, 36 * SLOWNESS):  # others who use the machine spoil the forecast of a run
        run = accurate(gudgeon, changed(text, "analysis.dynamic", end="1 s"), "--accuracy", "1e-6", "--budget", f"{budget}s", "--write",
                       "numbers", expect=(0, 5, 6))
        found = run.summary["accuracy"] if run.done.returncode != 5 else {"runs": 0}
        if found["runs"] >= 4 and found["claim"] == "horizon" and found["claimed_until"] > 0.02:
            break
    if found["runs"] < 4:
        pytest.skip("this machine makes no four runs in the time")
    assert found["claim"] == "horizon" and found["claimed_until"] > 0.02 and found["confirmed_by"]
    assert found["seconds"] < budget


TURNING = """deck = 1
[scene]
space = spatial
gravity = 0 0 -9.81 m/s^2
[bodies]
name mass[kg] ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2] x[m] y[m] z[m]
arm  2        0.01        0.1         0.1         0.5  0    0
[points]
name body   xi[m] eta[m] zeta[m]
o    ground 0     0      0
a    arm    -0.5  0      0
[joint.revolute]
name i j axis_i
pin  o a "0 1 0"
[driver.speed]
name  joint speed[rad/s]
motor pin   6.283185307179586
[analysis.dynamic]
end = 3 s
[output]
every    = 0.1 s
"""


def test_angles_that_go_round(gudgeon):
    """The angle of a joint in space jumps from pi to -pi, at output instants here: no error of a turn, and no digits lost."""
    run = accurate(gudgeon, TURNING + "channels = *\n", "--accuracy", "1e-6", "--quiet")
    found = run.summary["accuracy"]
    assert found["claim"] == "end" and found["claimed_until"] == 3.0
    row = extremes(run)["pin.angle"]
    assert row["error"] < 1e-6*math.pi
    ends = np.array([row["min"], row["max"]])  # half a turn is pi or -pi, by round-off
    assert np.abs(ends - np.round(ends/(0.2*math.pi))*0.2*math.pi).max() <= row["error"]
    assert np.abs(ends).max() >= math.pi - row["error"]


def test_orientation_is_among_positions(gudgeon):
    """Without `channels` the orientations of bodies in space are claimed too; here by the angle of the driver."""
    run = accurate(gudgeon, TURNING, "--accuracy", "1e-6", "--quiet")
    half = math.pi*run.time
    for name, truth in (("e0", np.cos(half)), ("e2", np.sin(half)), ("e1", 0*half), ("e3", 0*half)):
        row = extremes(run)[f"arm.orientation.{name}"]
        values = run.item("bodies/orientation", "arm")[:, int(name[1])]
        assert np.abs(values - truth).max() <= row["error"] + 1e-15
        assert_close(row["scale"], 1.0/(2.0*math.sqrt(0.05)), relative=1e-6, what=name)


def test_every_unit_has_a_scale_of_its_own(gudgeon):
    """The rise of temperature of a film in K beside its flow in m^3/s: each by its own greatest value, not both by the greater one."""
    text = (ROOT / "inputs" / "slider_crank_lubricated.deck").read_text()
    words = "gudgeon.side_flow gudgeon.temperature_rise gudgeon.film_power gudgeon.eccentricity_ratio"
    text = changed(changed(text, "output", channels=words, figures=None), "analysis.dynamic", end="2 ms")
    run = accurate(gudgeon, text, "--accuracy", "1e-5", "--quiet")
    for word in words.split():
        name = word.split(".")[1]
        greatest = np.nanmax(np.abs(run.item(f"clearances/{name}", "gudgeon")))  # no rise without flow
        assert greatest*(1.0 - 1e-3) <= extremes(run)[word]["scale"] <= 1.01*greatest, name  # located between output instants
        assert extremes(run)[word]["error"] <= 1e-5*extremes(run)[word]["scale"]


def test_members_of_an_ensemble(gudgeon):
    """The start of the member, not of the deck: the channels differ, and are those of the run with the tolerance found."""
    text = SPRING + ENSEMBLE
    first, run = (accurate(gudgeon, text, "--accuracy", "1e-6", "--quiet", *more) for more in ((), ("--member", "2")))
    again = accurate(gudgeon, text, "--tolerance", repr(run.summary["tolerance"]), "--member", "2", "--quiet")
    assert np.array_equal(run.read("bodies/position"), again.read("bodies/position"))
    assert not np.array_equal(run.read("bodies/position"), first.read("bodies/position"))
    x = run.item("bodies/position", "mass")[:, 0]
    assert x.max() <= extremes(run)["mass.position.x"]["max"] <= x.max() + 1e-6*np.ptp(x)


def test_spin_that_round_off_makes(gudgeon):
    """A bar that falls straight on pins, whose spin is none until they touch together: what is claimed holds for another method."""
    deck = make(167)
    run, other = (accurate(gudgeon, text, *options, "--quiet", expect=(0, 6)) for text, options in (
        (deck.text, ("--accuracy", repr(deck.accuracy))),
        (changed(deck.text, "analysis.dynamic", method="dop853", tolerance="1e-14"), ())))
    last = int(np.sum(run.time <= run.summary["accuracy"]["claimed_until"]*(1 + 1e-12)))
    assert last > 20
    for quantity, parts in (("position", 2), ("velocity", 2), ("angle", 1), ("angular_velocity", 1)):
        for k in range(parts):
            name = f"p.{quantity}" + (f".{'xy'[k]}" if parts > 1 else "")
            here, there = (one.item(f"bodies/{quantity}", "p").reshape(len(one.time), -1)[:last, k] for one in (run, other))
            assert np.max(np.abs(here - there)) <= 3.0*extremes(run)[name]["error"], name  # round-off of both is chance


def test_pin_in_the_middle(gudgeon):
    """Where a pin in the middle of its bearing would act is anywhere: it is claimed of what touches, and the rest of the run is not lost."""
    run = accurate(gudgeon, make(87).text, "--accuracy", "1e-3", "--quiet")
    assert run.summary["accuracy"]["claim"] == "end"
    touches = run.read("clearances/contacts/state")[:, 0] == 1
    assert not touches[0] and touches.any()
    for k, name in enumerate("xy"):
        claimed, column = extremes(run)[f"gudgeon.contact_point.{name}"], run.read("clearances/contacts/contact_point")[:, 0, k]
        rise = 0.01*np.ptp(column[touches])  # what is between the rows
        assert 0.0 <= column[touches].min() - claimed["min"] <= rise and 0.0 <= claimed["max"] - column[touches].max() <= rise
        assert 0 < claimed["error"] < 1e-3*claimed["scale"]


def test_condition_that_ends_the_run(gudgeon):
    """Runs that a condition ends at slightly different times are compared up to there."""
    run = accurate(gudgeon, SPRING + "[guards]\nstop = mass.velocity.x < -2.5m/s\n", "--accuracy", "1e-7", "--quiet")
    found = run.summary["accuracy"]
    assert found["claim"] == "end" and run.summary["time_end"] < END
    row = extremes(run)["mass.velocity.x"]
    assert abs(row["min"] + 2.5) <= row["error"]


@pytest.mark.parametrize(("options", "code", "words"), [
    (("--accuracy", "0"), 2, "needs a number from"),
    (("--accuracy", "-1"), 2, "needs a number from"),
    (("--accuracy", "abc"), 2, "needs a number from"),
    (("--accuracy", "1e-20"), 2, "needs a number from"),
    (("--accuracy", "2"), 2, "needs a number from"),
    (("--accuracy",), 2, "needs a value"),
    (("--accuracy", "1e-6", "--tolerance", "1e-8"), 2, "exclude each other"),
    (("--accuracy", "1e-6", "--legacy", "procedure1"), 2, "exclude each other"),
    (("--accuracy", "1e-6", "--budget", "5"), 2, "needs a time above zero with its unit"),
    (("--budget", "5s"), 2, "option --budget of 'run' needs --accuracy or --horizon"),
    (("--accuracy", "1e-6", "--member", "1"), 2, "option --member needs a deck with a section [ensemble]"),
])
def test_bad_options(gudgeon, options, code, words):
    done = call(gudgeon, "run", written(scratch(), SPRING), *options, expect=code)
    assert words in done.stderr


def test_what_it_does_not_go_with(gudgeon):
    """Fixed steps, analyses without a tolerance in time, channels without a true value, and the sweep."""
    fixed = changed(SPRING, "analysis.dynamic", method="rk4", step="1 ms")
    assert "'rk4' takes fixed steps" in accurate(gudgeon, fixed, "--accuracy", "1e-6", expect=2).done.stderr
    held = changed(fixed, "analysis.dynamic", method="verner", stabilise="baumgarte_step")
    assert "'baumgarte_step' takes fixed steps" in accurate(gudgeon, held, "--accuracy", "1e-6", expect=2).done.stderr
    kinematic = ROOT / "inputs" / "four_bar_kinematic.deck"
    assert "[analysis.dynamic]" in call(gudgeon, "run", kinematic, "--out", scratch() / "out", "--accuracy", "1e-6", expect=2).stderr
    residual = changed(SPRING, "output", channels="energy.residual")
    assert "no channel selected" in accurate(gudgeon, residual, "--accuracy", "1e-6", expect=2).done.stderr
    assert "unknown option '--accuracy'" in call(gudgeon, "sweep", DECK, "--accuracy", "1e-6", expect=2).stderr


def test_group_is_as_documented(gudgeon):
    """docs/reference/output.md names every attribute and dataset of /accuracy, and nothing else."""
    run = accurate(gudgeon, SPRING, "--accuracy", "1e-4", "--quiet")
    text = (ROOT / "docs/reference/output.md").read_text()
    with h5py.File(run.directory / "run.h5") as file:
        group = file["accuracy"]
        assert set(group) == set(re.findall(r"^\| `/accuracy/(\w+)`", text, flags=re.M))
        assert set(group.attrs) == set(re.findall(r"^\| `/accuracy` \| `(\w+)`", text, flags=re.M))
        assert plain(group["error"].attrs["units"]).split() == list(plain(group["units"][()]))


def test_debug_build_agrees(gudgeon_debug):
    """All run-time checks on: a spring, and a loose joint with impacts."""
    assert accurate(gudgeon_debug, SPRING, "--accuracy", "1e-5", "--quiet").summary["accuracy"]["claim"] == "end"
    loose = accurate(gudgeon_debug, make(15).text, "--accuracy", "1e-4", "--quiet")
    assert loose.summary["accuracy"]["claim"] in ("end", "horizon") and loose.summary["contacts"] > 0


def test_certification_of_a_dozen_decks(gudgeon):
    """Every family of random decks twice: what is claimed holds the true errors (`make certify`: 200 decks)."""
    verdicts = certify(gudgeon, range(12), 1, 1)
    assert not has_failed(verdicts)
    assert sum(verdict.verdict.startswith("holds") for verdict in verdicts) >= 11
