"""Comma-separated values beside the text files."""

import csv
import json

import numpy as np
from support import call, changed, plain_deck, scratch, written


def test_the_same_numbers_with_commas(gudgeon):
    """Cell by cell what the .dat files say, by the option and by the deck's key; a number that is not known is an empty cell."""
    deck = plain_deck()
    for text, options in ((deck, ["--csv"]), (changed(deck, "output", csv="on"), [])):
        directory = scratch()
        call(gudgeon, "run", written(directory, text), "--out", directory / "out", "--quiet", *options)
        found = sorted(path.stem for path in (directory / "out").glob("*.csv"))
        assert found == sorted(path.stem for path in (directory / "out").glob("*.dat")) and "events" in found
        for name in found:
            lines = (directory / "out" / f"{name}.dat").read_text().splitlines()
            rows = list(csv.reader((directory / "out" / f"{name}.csv").open(newline="")))
            assert rows[0] == lines[0][1:].split()
            expected = [line.split() for line in lines if not line.startswith("#")]
            assert rows[1:] == [["" if cell == "NaN" else cell for cell in row] for row in expected]
        summary = json.loads((directory / "out/summary.json").read_text())
        assert sorted(summary["csv"]) == [f"{name}.csv" for name in found]
        table = np.genfromtxt(directory / "out/slider.csv", delimiter=",", names=True)
        assert len(table) > 100 and table["times"][0] == 0


def test_without_it_there_are_none(gudgeon):
    directory = scratch()
    call(gudgeon, "run", written(directory, plain_deck()), "--out", directory / "out", "--quiet")
    assert not list((directory / "out").glob("*.csv"))
    assert "csv" not in json.loads((directory / "out/summary.json").read_text())
