"""Numbers that are not known, or not known yet, in the build that traps arithmetic with them: nothing of it ends the program."""

import csv

import pytest
from support import ROOT, Run, call, changed, plain_deck, scratch, written

STATISTICS = "\n[statistics]\nafter = 1 ms\nperiod = 1 ms\nchannels = motor.moment\n"


def short(*changes):
    """A few milliseconds of the dry slider-crank."""
    return plain_deck([("analysis.dynamic", "end", "4 ms"), ("output", "every", "1 ms"), *changes])


def test_a_case_without_a_run(gudgeon_debug):
    """A case of a sweep whose runs have all failed has no mean: its cells are empty."""
    directory = scratch()
    deck = written(directory, short() + STATISTICS + "\n[sweep]\nc = 0.5 20 mm\n")
    call(gudgeon_debug, "sweep", deck, "--out", directory / "out", "--jobs", 1, "--quiet", expect=8)
    rows = list(csv.DictReader((directory / "out" / "cases.csv").open()))
    assert [row["runs"] for row in rows] == ["1", "0"]
    assert float(rows[0]["motor.moment.rms mean [N.m]"]) > 0.0
    assert rows[1]["motor.moment.rms mean [N.m]"] == rows[1]["motor.moment.rms deviation [N.m]"] == ""


def test_statistics_of_few_instants_are_compared(gudgeon_debug):
    """The significance of means of five instants is not known: what differs by more than is allowed differs."""
    directory = scratch()
    for name, end in (("a", "4 ms"), ("b", "4 ms")):
        deck = written(directory, short(("analysis.dynamic", "end", end), ("parameters", "c", "0.5 mm" if name == "a" else "0.2 mm")))
        call(gudgeon_debug, "run", deck, "--quiet", "--out", directory / name)
    options = ("--quiet", "--statistics", "--out", directory / "c")
    call(gudgeon_debug, "compare", directory / "a", directory / "a", *options)
    call(gudgeon_debug, "compare", directory / "a", directory / "b", *options, expect=1)


@pytest.mark.parametrize("method", ["adams", "bdf", "ida"])
def test_gains_follow_before_the_first_step(gudgeon_debug, method):
    """A library of methods with a history has no step before its first: the gain that follows does without it."""
    directory = scratch()
    text = short(("analysis.dynamic", "method", method), ("analysis.dynamic", "stabilise", "baumgarte_adaptive"))
    call(gudgeon_debug, "run", written(directory, text), "--quiet", "--out", directory / "out")
    assert Run(directory / "out").summary["status"] == "complete"


def test_orbit_of_what_is_not_round(gudgeon_debug):
    """A ball on a plane has no clearance and no orbit, which is a mistake of the deck."""
    directory = scratch()
    text = changed((ROOT / "inputs" / "bouncing_ball.deck").read_text(), "output", figures="floor.orbit")
    done = call(gudgeon_debug, "check", written(directory, text), expect=3)
    assert "no orbit of 'floor'" in done.stderr


def test_no_accuracy_has_no_worst_channel(gudgeon_debug):
    """Where runs part before the first instant nothing is claimed, and no channel is named that limits it."""
    directory = scratch()
    output = {"figures": None, "from": None, "last": None, "every": "30 ms"}
    text = changed((ROOT / "inputs" / "slider_crank_two_joints.deck").read_text(), "output", **output)
    text = changed(text, "analysis.dynamic", end="60 ms")
    options = ("--accuracy", "1e-4", "--write", "channels", "--quiet")
    call(gudgeon_debug, "run", written(directory, text), "--out", directory / "out", *options, expect=6)
    accuracy = Run(directory / "out").summary["accuracy"]
    assert accuracy["claim"] == "none" and accuracy["limited_by"] == "" and accuracy["extremes"] == []
