"""Rows of the time histories at the onset, peak and end of every contact: what events.dat tells, the histories show.

The references are the list of events, momentum, and the run without these rows.
"""

import functools
import re

import numpy as np
import pytest
from conftest import ROOT
from support import DECK, Run, assert_close, call, changed, plain_deck, scratch, text_of, written

METHODS = ("verner", "dop853", "rk4", "rock4", "radau", "adams", "bdf", "ida")
FOLDERS = ("inputs", "inputs/hard", "inputs/studies")
STEP = {"inputs/hard/dropped_ball.deck": "10 us", "inputs/bouncing_ball.deck": "10 us"}  # of rk4; others take 1 us
END = {  # of motions that are long; others run as they are
    "inputs/bouncing_ball.deck": "0.65 s",
    "inputs/crosshead.deck": "0.02 s",
    "inputs/double_pendulum.deck": "0.5 s",
    "inputs/four_bar_spatial.deck": "0.3 s",
    "inputs/friction.deck": "0.05 s",
    "inputs/incline.deck": "0.05 s",
    "inputs/shaken_pendulum.deck": "0.05 s",
    "inputs/hard/dropped_ball.deck": "0.8 s",
    "inputs/hard/pin_at_rest.deck": "0.03 s",
    "inputs/hard/wedged_slider.deck": "5 ms",
}
ONSET, PEAK, END_ROW, JUMP = 1, 2, 3, 4


DECKS = [
    path
    for folder in FOLDERS
    for path in sorted((ROOT / folder).glob("*.deck"))
    if re.search(r"(?m)^\s*\[clearance\.", text_of(path)) and re.search(r"(?m)^\s*\[analysis\.dynamic\]", text_of(path))
    and not re.search(r"(?m)^\s*\[lubricant\]", text_of(path))  # films hold these surfaces apart
]


def shortened(deck, method):
    """A deck's text for a short motion by a method, without figures (one, where those of an included deck would come), every channel written."""
    name = str(deck.relative_to(ROOT))
    text = re.sub(r'(?m)^(\s*include\s+)"([^"]+)"', lambda found: f'{found.group(1)}"{deck.parent / found.group(2)}"', deck.read_text())
    end = END.get(name)
    settings = {"analysis.dynamic": {"method": method, "end": end}, "output": {"figures": "", "channels": "*", "from": "0 s"}}
    if "slider_crank" in text:
        end = settings["analysis.dynamic"]["end"] = "4 ms"
        settings["output"]["every"] = "20 us"
    if method == "rk4":
        settings["analysis.dynamic"]["step"] = STEP.get(name, "1 us")
    if end is None:
        del settings["analysis.dynamic"]["end"]
    if "[statistics]" in text:
        settings["statistics"] = {"after": "0 s", "period": "2 ms"}
    for section, keys in settings.items():
        if not re.search(rf"(?m)^\s*\[{re.escape(section)}\]", text):
            text += f"\n[{section}]\n"
        text = changed(text, section, **keys)
    return changed(text, "output", figures="slider.velocity" if "include " in text else None)


def run_of(program, text, *options):
    """A run of a deck."""
    directory = scratch()
    call(program, "run", written(directory, text), "--out", directory / "out", "--quiet", *options)
    return Run(directory / "out")


def contacts_by_column(run):
    """For each contact of the joints with clearance: its column in run.h5, its name in .dat files, and its events."""
    joints, labels = run.read("clearances/contact_joint"), run.read("clearances/contact_label")
    events = run.contacts
    for column, (joint, label) in enumerate(zip(joints, labels)):
        mine = [k for k, row in enumerate(events) if (row["item"].decode(), row["contact"].decode()) == (joint, label)]
        yield column, joint, ".".join(filter(None, (joint, label))), events[mine]


def check_peaks(run):
    """The greatest force of the histories is that of the list of events, for each contact and for each impact."""
    time, force = run.rows("time"), run.rows("clearances/contacts/normal_force")
    assert len(run.contacts) > 0
    for column, joint, name, events in contacts_by_column(run):
        names, rows = run.table(f"{joint}.dat")
        written_force = np.array([float(row[names.index(f"{name}.normal_force")]) for row in rows])
        if len(events) == 0:
            assert force[:, column].max() == 0.0 and written_force.max() == 0.0
            continue
        assert_close(force[:, column].max(), events["peak_force"].max(), relative=1e-6, what=f"run.h5, {name}")
        assert_close(written_force.max(), events["peak_force"].max(), relative=1e-6, what=f"{joint}.dat, {name}")
        for event in events:
            end = event["time"] + (event["duration"] if np.isfinite(event["duration"]) else np.inf)
            within = (time >= event["time"]) & (time <= end)
            assert_close(force[within, column].max(), event["peak_force"], relative=1e-6, what=f"{name} at {event['time']}")


def check_order(run):
    """Times never fall; two rows have the same one only where a contact changes. The text tells every instant apart."""
    time, kind = run.rows("time"), run.rows("row_kind")
    assert np.all(np.diff(time) >= 0)
    assert np.all(np.diff(time[kind == 0]) > 0)
    pairs = np.flatnonzero(np.diff(time) == 0)
    assert np.all(kind[pairs + 1] != 0), "the second row of a pair is one of a contact"
    for path in run.directory.glob("*.dat"):
        if path.name == "events.dat" or path.name.endswith(".ideal.dat"):
            continue
        names, rows = run.table(path.name)
        assert names[-1] == "row_kind"
        assert np.array_equal([float(row[0]) for row in rows], time)
        assert np.array_equal([float(row[-1]) for row in rows], kind)


@pytest.mark.slow
@pytest.mark.parametrize("deck", DECKS, ids=lambda path: path.stem)
def test_histories_hold_the_peaks_of_the_events(gudgeon, deck):
    run = run_of(gudgeon, shortened(deck, "verner"))
    check_peaks(run)
    check_order(run)


@pytest.mark.slow
@pytest.mark.parametrize("method", METHODS[1:])
@pytest.mark.parametrize("name", ["slider_crank_two_joints", "shaken_pendulum", "hard/wedged_slider", "friction"])
def test_by_every_method(gudgeon, name, method):
    deck = ROOT / "inputs" / f"{name}.deck"
    run = run_of(gudgeon, shortened(deck, method))
    check_peaks(run)
    check_order(run)


@functools.lru_cache(maxsize=None)
def impact(program, law, form="squared", *changes):
    """One impact of a free journal by a law."""
    directory = scratch()
    text = changed((ROOT / "inputs/impact.deck").read_text(), "output", figures=None, every="3 us")
    text = changed(text, "analysis.dynamic", **dict(changes))
    call(program, "run", written(directory, text), "--out", directory / "out", "--quiet",
         "--set", f"law={law}", "--set", f"form={form}", "--set", "restitution=0.3")
    return Run(directory / "out")


@pytest.mark.parametrize("law", re.findall(r"(?m)^\[contact\.(\w+)\]", (ROOT / "inputs/impact.deck").read_text()))
def test_every_law(gudgeon, law):
    run = impact(gudgeon, law)
    check_peaks(run)
    check_order(run)
    kinds = run.rows("row_kind")
    assert [np.count_nonzero(kinds == kind) for kind in (ONSET, END_ROW)] == [1, np.isfinite(run.contacts["duration"][0])]


@pytest.mark.parametrize("onset", ["located", "interpolate", "reject", "uncontrolled"])
def test_every_way_of_meeting_onsets(gudgeon, onset):
    run = impact(gudgeon, "lankarani_nikravesh", "squared", ("contact_onset", onset), ("maximum_step", "1 us"))
    check_peaks(run)
    check_order(run)
    onsets = run.rows("row_kind") == ONSET
    assert np.array_equal(run.rows("time")[onsets], run.contacts["time"])
    assert np.count_nonzero(run.rows("row_kind") == JUMP) == (onset != "located")


def test_rows_tell_what_the_event_tells(gudgeon):
    """Onset, peak and end of one impact: instants, speeds of approach and separation, and the momentum between them."""
    run = impact(gudgeon, "lankarani_nikravesh")
    (event,) = run.contacts
    time, kind = run.rows("time"), run.rows("row_kind")
    onset, peak, end = (np.flatnonzero(kind == sort)[0] for sort in (ONSET, PEAK, END_ROW))
    assert time[onset] == event["time"]
    assert_close(time[end] - time[onset], event["duration"], absolute=1e-16)
    rate = run.rows("clearances/contacts/penetration_rate")[:, 0]
    assert_close([rate[onset], -rate[end]], [event["impact_speed"], event["release_speed"]], relative=1e-12)
    assert np.array_equal(run.rows("clearances/contacts/state")[[onset, peak, end], 0], [1, 1, 1])
    speed = run.rows("bodies/velocity")[:, 0, 0]
    assert_close(speed[onset] - speed[end], event["impact_speed"] + event["release_speed"], relative=1e-12, what="momentum")
    # the force is the journal's mass times its acceleration, and greatest at the peak: its rate changes sign there
    force = run.rows("clearances/contacts/normal_force")[:, 0]
    assert_close(force, -0.14 * run.rows("bodies/acceleration")[:, 0, 0], 1e-9 * force.max(), what="force")
    assert force[peak] == force.max() > run.read("clearances/contacts/normal_force").max()


def test_a_dashpot_shows_both_sides_of_its_jump(gudgeon):
    """Kelvin and Voigt's dashpot has C v0 at once: two rows of the same time, zero and C v0; a strong one is never greater."""
    run = impact(gudgeon, "kelvin_voigt", "dashpot")
    time, kind = run.rows("time"), run.rows("row_kind")
    onset = np.flatnonzero(kind == ONSET)[0]
    assert kind[onset - 1] == JUMP and time[onset - 1] == time[onset]
    force = run.rows("clearances/contacts/normal_force")[:, 0]
    zeta = -np.log(0.3) / np.hypot(np.pi, np.log(0.3))
    damping = 2 * zeta * np.sqrt(1.5e8 * 0.14)
    assert force[onset - 1] == 0.0
    assert_close(force[onset], damping * run.contacts["impact_speed"][0], relative=1e-9, what="C v0")
    directory = scratch()
    text = changed((ROOT / "inputs/impact.deck").read_text(), "output", figures=None, every="3 us")
    call(gudgeon, "run", written(directory, text), "--out", directory / "out", "--quiet",
         "--set", "law=kelvin_voigt", "--set", "form=dashpot", "--set", "restitution=0.05")
    strong = Run(directory / "out")
    zeta = -np.log(0.05) / np.hypot(np.pi, np.log(0.05))
    assert zeta > 0.5, "the force falls from its onset on"
    at_once = 2 * zeta * np.sqrt(1.5e8 * 0.14) * strong.contacts["impact_speed"][0]
    assert_close(strong.contacts["peak_force"][0], at_once, relative=1e-9, what="greatest at the onset")
    check_peaks(strong)


def test_a_law_that_jumps_at_the_turn_shows_both_sides(gudgeon):
    """K delta while approaching, 0.09 of it while parting: the peak and what is left of it have the same time."""
    run = impact(gudgeon, "kelvin_voigt", "squared")
    time, kind = run.rows("time"), run.rows("row_kind")
    force = run.rows("clearances/contacts/normal_force")[:, 0]
    peak = np.argmax(force)
    assert kind[peak] == PEAK and kind[peak + 1] == JUMP and time[peak] == time[peak + 1]
    assert_close(force[peak + 1], 0.09 * force[peak], relative=1e-6, what="force during separation")


def test_equal_spacing(gudgeon):
    """Without the rows the histories are as they were: the same numbers on the output instants, and nothing else."""
    with_rows = run_of(gudgeon, shortened(DECK, "verner"))
    text = shortened(DECK, "verner")
    without = run_of(gudgeon, changed(text, "output", contact_rows="off"))
    assert np.all(without.rows("row_kind") == 0)
    assert_close(np.diff(without.rows("time")), np.diff(without.rows("time"))[0], absolute=1e-12)
    names, rows = without.table("gudgeon.dat")
    assert "row_kind" not in names
    assert len(rows) == without.summary["samples"]
    for path in ("time", "bodies/position", "clearances/force", "energy/residual"):
        assert np.array_equal(with_rows.read(path), without.read(path), equal_nan=True), path
    for field in with_rows.contacts.dtype.names:
        both = [run.contacts[field] for run in (with_rows, without)]
        assert np.array_equal(*both, equal_nan=both[0].dtype.kind == "f"), f"the events are the same: {field}"
    kinds = with_rows.rows("row_kind")
    told = [with_rows.summary[f"{sort}_rows"] for sort in ("onset", "peak", "end", "jump")]
    assert told == [np.count_nonzero(kinds == kind) for kind in (ONSET, PEAK, END_ROW, JUMP)] and min(told[:3]) > 0
    assert len(kinds) == with_rows.summary["samples"] + sum(told)
    assert re.search(rf"rows +{sum(told)} additional output rows at contact events", (with_rows.directory / "summary.txt").read_text())


STATISTICS = """
[statistics]
after    = 2 ms
period   = 3 ms
channels = gudgeon.normal_force motor.moment slider.acceleration.x
spectra  = motor.moment
"""


def test_statistics_take_the_rows_for_extremes_only(gudgeon):
    """All numbers to the last bit as without the rows: extremes are those of the events in both."""
    text = plain_deck([("analysis.dynamic", "end", "9 ms"), ("output", "every", "20 us")]) + STATISTICS
    runs = [run_of(gudgeon, changed(text, "output", contact_rows=word)) for word in ("on", "off")]
    numbers = [dict(zip(run.read("statistics/names"), run.read("statistics/values"))) for run in runs]
    for name in numbers[0]:
        assert np.array_equal(numbers[0][name], numbers[1][name], equal_nan=True), name
    for path in ("statistics/spectrum", "statistics/strobe", "statistics/histogram_counts", "statistics/frequency"):
        assert np.array_equal(*(run.read(path) for run in runs)), path
    begun = runs[0].contacts["time"] >= 2e-3
    assert_close(numbers[0]["gudgeon.normal_force.max"], runs[0].contacts["peak_force"][begun].max(), relative=1e-6)
    window = runs[1].rows("time") >= 2e-3  # rows of output instants only: their greatest force and moment are less
    force, moment = (runs[1].rows(path).reshape(len(window), -1)[window] for path in ("clearances/contacts/normal_force", "drivers/moment"))
    assert np.nanmax(force) < numbers[1]["gudgeon.normal_force.max"] and np.abs(moment).max() <= numbers[1]["motor.moment.peak"]
    bare = run_of(gudgeon, changed(text, "output", contact_rows="on"), "--write", "numbers")
    assert np.array_equal(bare.read("statistics/values"), runs[0].read("statistics/values"), equal_nan=True)


def test_a_run_that_ends_within_a_contact(gudgeon):
    """The end falls into the first impact, between output instants: the last row is the greatest force so far."""
    onset = impact(gudgeon, "hertz").contacts["time"][0]
    text = changed((ROOT / "inputs/impact.deck").read_text(), "output", figures=None, every="0.7 us")
    text = changed(text, "analysis.dynamic", end=f"{onset + 10e-6:.9g} s")
    run = run_of(gudgeon, text)
    assert run.rows("row_kind")[-1] == PEAK
    assert run.rows("time")[-1] == run.summary["time_end"]
    check_peaks(run)


def test_only_what_is_written_has_rows(gudgeon):
    """Output that begins late has no rows before it; a run without histories has none at all."""
    text = changed(shortened(DECK, "verner"), "output", **{"from": "2 ms"})
    run = run_of(gudgeon, text)
    assert run.rows("time")[0] == 2e-3
    assert run.summary["onset_rows"] == np.count_nonzero(run.contacts["time"] >= 2e-3)
    assert sum(run_of(gudgeon, text, "--write", "numbers").summary[f"{sort}_rows"] for sort in ("onset", "peak", "end")) == 0


def test_explain_and_a_wrong_word(gudgeon):
    assert "output rows at onset, peak and separation of every contact (contact_rows = auto: up to 64" in call(gudgeon, "explain", DECK).stdout
    text = changed(shortened(DECK, "verner"), "output", contact_rows="no")
    done = call(gudgeon, "check", written(scratch(), text), expect=3)
    assert "auto on off" in done.stderr or "auto, on, off" in done.stderr


def many_balls(count):
    """Balls over a plane, each for itself."""
    rows = "\n".join(f"b{k} 0.1 1e-5 {0.1 * k} 0.02 0" for k in range(count))
    points = "\n".join(f"c{k} b{k} 0 0" for k in range(count))
    joints = "\n".join(f"p{k} floor c{k} y 10 steel law" for k in range(count))
    return f"""deck = 1
[scene]
space = planar
gravity = 0 -9.81 m/s^2
[bodies]
name mass[kg] inertia[kg.m^2] x[m] y[m] angle[deg]
{rows}
[points]
name body xi[mm] eta[mm]
floor ground 0 0
{points}
[material]
name young[GPa] poisson density[kg/m^3]
steel 207 0.3 7850
[clearance.plane]
name plane ball axis radius[mm] material law
{joints}
[contact.hertz]
name
law
[analysis.dynamic]
end = 60 ms
[output]
every = 5 ms
"""


def test_scenes_of_many_contacts(gudgeon):
    """Beyond 64 contacts there are no rows unless they are asked for, and the summary says so."""
    quiet = run_of(gudgeon, many_balls(65))
    assert len(quiet.contacts) == 65 and np.all(quiet.rows("row_kind") == 0)
    assert "no output rows at onset, peak and separation of every contact (contact_rows = auto: up to 64 contacts, here 65)" in (
        quiet.directory / "summary.txt"
    ).read_text()
    asked = run_of(gudgeon, changed(many_balls(65), "output", contact_rows="on"))
    check_peaks(asked)
    few = run_of(gudgeon, many_balls(64))
    assert few.summary["onset_rows"] > 0
    check_peaks(few)
