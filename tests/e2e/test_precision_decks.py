"""`gudgeon precision` on every deck of inputs/ and inputs/hard: errors fall with the tolerance, or the report says why they do not.

Decks are found by themselves. A copy of each says what is different: a ladder of eleven tolerances, no twins, and of some that take
long a part of the motion.
"""

import csv
import json
import math
import re
import statistics

import pytest
from conftest import ROOT
from support import call, changed, scratch, text_of, written

DECKS = sorted(path for folder in ("inputs", "inputs/hard") for path in (ROOT / folder).glob("*.deck"))
LADDER = "\n[precision]\ncoarsest = 1e-4\nfinest = 1e-9\nper_decade = 2\nrounds = 1\ninstants = 50\nperturbation = 0\n"
SHORTER = {"cantilever_beams": "2 ms", "a02_four_bars_40": "0.5 s", "shaken_pendulum": "0.05 s", "friction": "0.2 s", "journal_bearing": "0.05 s",
           "big_end": "0.5 ms", "stressed_bearing": "0.02 s", "double_pendulum": "0.1 s", "four_bar_spatial": "0.1 s", "a05_flyball": "0.4 s",
           "crosshead": "0.02 s", "slider_crank_lubricated": "24 ms", "slider_crank_6_6_bushing": "8 ms", "slider_crank_6_6_ball": "8 ms",
           "slider_crank_6_6_lubricated": "8 ms"}
KINEMATIC = ("four_bar_kinematic", "tolerance_four_bar", "tolerance_slider_crank")
REFUSED = {"dead_point": (5, "no run was completed"), **dict.fromkeys(KINEMATIC, (2, "the comparison needs [analysis.dynamic]"))}
LEAST_FALL = 3  # of the median error of a decade over two decades; in proportion it is 100


def deck_text(deck):
    """A deck with files at their places and a ladder."""
    text = deck.read_text()
    text = re.sub(r'(?m)^(\s*include\s+)"([^"]+)"', lambda found: f'{found.group(1)}"{deck.parent / found.group(2)}"', text)
    text = re.sub(r'"([^"/\s]+\.txt)"', lambda found: f'"{deck.parent / found.group(1)}"', text)
    if deck.stem in SHORTER:
        text = changed(text, "analysis.dynamic", end=SHORTER[deck.stem])
    return text + LADDER


def medians(rows, hidden):
    """Median error of each decade of tolerances, of two runs at least that the reference does not hide."""
    decades = {}
    for row in rows:
        if row["state"] == "done" and row["motion"] and float(row["motion"]) > hidden:
            place = math.floor(math.log10(1e-4 / float(row["asked"])) + 1e-6)
            decades.setdefault(place, []).append(float(row["motion"]))
    return {place: statistics.median(errors) for place, errors in decades.items() if len(errors) > 1}


@pytest.mark.parametrize("deck", DECKS, ids=lambda deck: deck.stem)
def test_errors_fall_or_the_report_says_why(gudgeon, deck):
    """Over any two decades of tolerance by a factor of 3 at least, until the reference's own error; else a line names the cause."""
    directory = scratch()
    code, words = REFUSED.get(deck.stem, (0, ""))
    done = call(gudgeon, "precision", written(directory, deck_text(deck)), "--methods", "verner", "--out", directory / "out", "--quiet", expect=code)
    assert words in done.stderr
    if code:
        return
    summary = json.loads((directory / "out" / "summary.json").read_text())
    assert summary["confirmed_by"] and not any("cause unknown" in line for line in summary["bends"]), summary["bends"]
    rows = list(csv.DictReader((directory / "out" / "precision.csv").open()))
    assert summary["not_run"] == 0 and sum(row["state"] == "done" for row in rows) >= 4
    errors = medians(rows, 10 * summary["reference_error"])
    bent = [place for place in errors if place + 2 in errors and errors[place] < LEAST_FALL * errors[place + 2]]
    assert not bent or summary["bends"], (errors, bent)
    report = (directory / "out" / "summary.txt").read_text()
    assert all(line in report for line in summary["bends"])


@pytest.mark.parametrize(
    "name, words",
    [
        ("hard/grazed_plane", "errors fall by less than a factor of 3 over two decades; its number of steps hardly changes (7 to 8)"),
        ("four_bar", "the errors are as large as the motion itself"),
        ("hard/a02_four_bars_1", "held: verner, 11 runs: the 'maximum_step' of the deck"),
    ],
)
def test_causes_are_named(gudgeon, name, words):
    """A parabola, whose errors are round-off but where steps are shorter for an event; constraints that drift; steps that the deck holds."""
    directory = scratch()
    text = deck_text(ROOT / "inputs" / f"{name}.deck").replace("finest = 1e-9", "finest = 1e-11" if "plane" in name else "finest = 1e-9")
    call(gudgeon, "precision", written(directory, text), "--methods", "verner", "--out", directory / "out", "--quiet")
    bends = json.loads((directory / "out" / "summary.json").read_text())["bends"]
    assert any(words in line for line in bends), bends


@pytest.mark.parametrize(
    "name, method, words",
    [
        ("hard/grazed_plane", "rk4", "the errors are constant: their source, as a grazing contact, is shorter than all these steps"),
        ("bouncing_ball", "ida", "the errors of neighbouring runs scatter: in some runs errors of opposite sign cancel"),
    ],
)
def test_causes_of_other_methods_are_named(gudgeon, name, method, words):
    """A contact of 28 us that no fixed step is shorter than; a run of `ida` whose errors at two bounces cancel."""
    directory = scratch()
    text = deck_text(ROOT / "inputs" / f"{name}.deck").split("[precision]")[0] + "\n[precision]\nrounds = 1\nperturbation = 0\n"
    call(gudgeon, "precision", written(directory, text), "--methods", method, "--out", directory / "out", "--quiet")
    bends = json.loads((directory / "out" / "summary.json").read_text())["bends"]
    assert any(words in line for line in bends), bends
    assert not any("cause unknown" in line for line in bends), bends
    if method == "rk4":
        duration = [float(line.split()[9]) for line in grazing(gudgeon)]
        steps = [float(row["asked"]) for row in csv.DictReader((directory / "out" / "precision.csv").open())]
        assert max(duration) < min(steps)


def grazing(program):
    """The contacts of the ball that grazes a plane, rows of events.dat."""
    directory = scratch()
    call(program, "run", ROOT / "inputs" / "hard" / "grazed_plane.deck", "--tolerance", "1e-12", "--out", directory / "out", "--quiet")
    return [line for line in (directory / "out" / "events.dat").read_text().splitlines() if line and not line.startswith("#")]
