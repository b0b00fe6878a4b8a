"""A number that is not known is missing: null in JSON, empty in csv, `-` in text, never NaN or Infinity; and the run says why."""

import json
import re

import pytest
from conftest import ROOT
from support import Run, call, changed, scratch, text_of, written
from test_one_peak import DECKS, KINEMATIC, text_of_deck

TOKEN = re.compile(r"(?<![\w.-])[-+]?(?:nan|inf(?:inity)?)(?![\w.-])", re.IGNORECASE)
TEXTS = ("*.json", "*.txt", "*.csv", "report.html")  # `.dat` files are of gnuplot, whose word for what is missing is NaN
SHORT = 0.02  # of the motion of a deck, where that is all that is looked at


def check(directory):
    files = [path for pattern in TEXTS for path in sorted(directory.glob(pattern))]
    assert any(path.suffix == ".json" for path in files)
    for path in files:
        text = path.read_text()
        if path.suffix == ".html":  # what people read of the page
            text = re.sub(r"(?s)<(script|style)\b.*?</\1>", "", text)
        found = TOKEN.search(text)
        assert not found, f"{path.name}: {text[max(0, found.start() - 80):found.end() + 40]!r}"
        if path.suffix == ".json":
            json.loads(text, parse_constant=lambda word: pytest.fail(f"{path.name}: {word}"))


def run_of(gudgeon, text, *options, **settings):
    directory = scratch()
    for section, keys in settings.items():
        text = changed(text, section.replace("__", "."), **keys)
    call(gudgeon, "run", written(directory, text), "--quiet", "--csv", "--out", directory / "out", *options, expect=None)
    return directory / "out"


def with_statistics(text):
    return text + "\n[statistics]\nafter = 0 s\nchannels = *\n"


@pytest.mark.parametrize("deck", DECKS + KINEMATIC, ids=lambda path: path.stem)
def test_statistics_of_decks(gudgeon, deck):
    analysis = "kinematic" if deck in KINEMATIC else "dynamic"
    check(run_of(gudgeon, with_statistics(text_of_deck(deck, analysis)), "--analysis", analysis))


@pytest.mark.parametrize("deck", DECKS, ids=lambda path: path.stem)
def test_end_at_the_first_row(gudgeon, deck):
    """One output instant: there is no mean and no RMS, and a warning says so."""
    text = with_statistics(text_of_deck(deck))
    text = text if "[guards]" in text else text + "\n[guards]\n"
    directory = run_of(gudgeon, text, guards={"stop": "energy.kinetic > -1 J"})
    check(directory)
    run = Run(directory)
    assert run.summary["samples"] == 1
    assert any("no mean and no RMS" in line or "no statistics: the run ended before their start" in line for line in run.summary["warnings"])


@pytest.mark.parametrize("name", ["slider_crank_dry", "four_bar", "bouncing_ball", "double_pendulum", "slider_crank_6_6_planar"])
def test_accuracy_and_horizon(gudgeon, name):
    text = text_of_deck(ROOT / f"inputs/{name}.deck")
    text = changed(text, "analysis.dynamic", end="2 ms")
    text = changed(text, "output", every="20 us")
    check(run_of(gudgeon, text, "--accuracy", "1e-3"))
    check(run_of(gudgeon, text, "--horizon"))


def test_place_of_a_contact_that_never_touches(gudgeon):
    """Where the pin would act is no number before it touches: its interval is missing, and the table says why."""
    text = text_of_deck(ROOT / "inputs/slider_crank_dry.deck")
    text = changed(changed(text, "analysis.dynamic", end="0.1 ms"), "output", every="1 us")
    directory = run_of(gudgeon, text, "--accuracy", "1e-3")
    run = Run(directory)
    place = next(e for e in run.summary["accuracy"]["extremes"] if e["name"] == "gudgeon.contact_point.x")
    assert place["min"] is None and place["max"] is None
    assert "only during contact" in (directory / "summary.txt").read_text()
    check(directory)
