"""Conditions that end a run where its error, not the motion, meets them: against x = cos 10 t."""

import math

import pytest
from support import Run, call, changed, scratch, written
from test_rows_of_stiff_steps import OVERDAMPED

# the scene of the other test, undamped and let go at rest
OSCILLATOR = changed(OVERDAMPED, "analysis.dynamic", start=None, end="END").replace("0           -1", "0           0")
OSCILLATOR = OSCILLATOR.replace("1e6             5               1e6", "100             5               0")
OSCILLATOR += "\n[guards]\nstop = block.position.x < LOW\n"


def study(gudgeon, low, end, *options):
    """What a comparison of settings prints, and its choice."""
    directory = scratch()
    deck = written(directory, OSCILLATOR.replace("LOW", low).replace("END", end))
    done = call(gudgeon, "precision", deck, "--budget", "4s", "--out", directory / "out", *options)
    return done.stdout, [line for line in done.stdout.splitlines() if line.startswith("choice")][0]


def test_a_setting_that_stops_too_early_is_not_chosen(gudgeon):
    """x never falls below -1: settings with errors above 1e-10 stop at pi/10 of 2 s all the same, and are told as another motion."""
    words, choice = study(gudgeon, "-1.0000000001 m", "2 s", "--methods", "verner dop853 adams")
    assert "its end time differs from that of the reference" in words
    directory = scratch()
    deck = written(directory, OSCILLATOR.replace("LOW", "-1.0000000001 m").replace("END", "2 s"))
    method, tolerance = (choice.split(f"{key} = ")[1].split(",")[0].split(":")[0] for key in ("method", "tolerance"))
    call(gudgeon, "run", deck, "--method", method, "--tolerance", tolerance, "--out", directory / "out", "--quiet")
    assert Run(directory / "out").summary["time_end"] == pytest.approx(2.0)


def test_instants_are_of_what_there_is_of_the_motion(gudgeon):
    """A motion of 0.19 s in a deck of 100 s is compared at 201 instants: steps that go past its end are not the cheapest."""
    words, choice = study(gudgeon, "-0.3 m", "100 s", "--methods", "verner rk4")
    compared = [line for line in words.splitlines() if line.startswith("compared")][0]
    assert f"{math.acos(-0.3) / 10:.6g} s" in compared and "at 201 output times" in compared
    assert "method = verner" in choice


@pytest.mark.parametrize("low", ["-1.00001 m", "-1.0000001 m"])
def test_the_search_goes_on_behind_a_false_end(gudgeon, low):
    """What confirms the run goes on where that was stopped: it is made tighter until it is not, and the accuracy holds to the end."""
    directory = scratch()
    deck = written(directory, OSCILLATOR.replace("LOW", low).replace("END", "2 s"))
    loose = call(gudgeon, "run", deck, "--method", "adams", "--tolerance", "1e-5", "--out", directory / "loose", "--write", "numbers")
    assert Run(directory / "loose").summary["time_end"] == pytest.approx(math.pi / 10, rel=1e-2), loose.stdout
    done = call(gudgeon, "run", deck, "--method", "adams", "--accuracy", "1e-3", "--out", directory / "out")
    summary = Run(directory / "out").summary
    assert summary["time_end"] == 2.0 and summary["accuracy"]["claim"] == "end", done.stdout
