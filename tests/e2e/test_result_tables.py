"""A result is one table: each file has the same numbers, read by h5py, json, csv and html.parser."""

import csv
import html.parser
import json
import math
import re

import h5py
import pytest
from support import DECK, ROOT, call, changed, plain_deck, scratch, written

EXTREMES = "least least_time greatest greatest_time mean rms".split()
JOINTS = """impacts contact_fraction impact_speed impact_speed_onset peak_force peak_force_onset peak_force_time peak_penetration
peak_penetration_onset peak_penetration_time impulse energy_lost""".split()


class Cells(html.parser.HTMLParser):
    """The rows of each section of a page."""

    def __init__(self, text):
        super().__init__()
        self.rows, self.section, self.is_cell = {}, "", False
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        """A section, a row or a cell."""
        self.is_cell = tag in ("td", "th")
        if tag == "h2":
            self.section = dict(attrs)["id"]
        elif tag == "tr":
            self.rows.setdefault(self.section, []).append([])
        elif self.is_cell:
            self.rows[self.section][-1].append("")

    def handle_endtag(self, tag):
        """The end of a cell."""
        self.is_cell = False

    def handle_data(self, data):
        """Text of a cell."""
        if self.is_cell:
            self.rows[self.section][-1][-1] += data


def known(values):
    """Numbers with None for NaN, as in JSON."""
    return [None if math.isnan(x) else x for x in map(float, values)]


@pytest.fixture(name="run")
def short_run(gudgeon):
    """A short run with statistics and a page."""
    text = changed(plain_deck(), "analysis.dynamic", end="12 ms")
    text = changed(text, "output", report="on") + "\n[statistics]\nafter = 2 ms\nchannels = motor.moment\nspectra = motor.moment\n"
    directory = scratch()
    call(gudgeon, "run", written(directory, text), "--out", directory / "out", "--quiet")
    return directory / "out"


def test_run_h5_and_summary_json(run):
    """Every value, missing ones too, is the same to the last bit."""
    summary = json.loads((run / "summary.json").read_text())
    with h5py.File(run / "run.h5") as file:
        group = file["extremes/channels"]
        assert [row["channel"] for row in summary["extremes"]] == [name.decode() for name in group["name"]]
        for key in EXTREMES:
            assert [row[key] for row in summary["extremes"]] == known(group[key]), key
        for key in JOINTS:
            assert [row[key] for row in summary["loose_joints"]] == known(file[f"extremes/joints/{key}"]), key
        names = [name.decode() for name in file["statistics/names"]]
        assert list(summary["statistics"]) == names and list(summary["statistics"].values()) == known(file["statistics/values"])
        units = file["statistics/values"].attrs["units"].split()
        assert units == [unit.decode() for unit in file["statistics/units"]]
        assert file["statistics/spectrum"].shape == (len(file["statistics/frequency"]), 1)
        events = file["events"][()]
    contacts = sorted(events[events["kind"] == b"contact"].tolist())
    for row, event in zip(summary["first_impacts"], contacts):
        assert row["time"] == event[0] and row["impact_speed"] == event[6]
    assert len(summary["first_impacts"]) == 5


def test_texts_are_rounded(run):
    """summary.txt and report.html have the digits that they show."""
    summary = json.loads((run / "summary.json").read_text())
    row = next(row for row in summary["extremes"] if row["channel"] == "motor.moment")
    line = re.search(r"^ +motor\.moment \[N\.m\] +(.*)$", (run / "summary.txt").read_text(), re.M).group(1)
    shown = [float(cell) for cell in line.split()]
    assert shown == pytest.approx([row[key] for key in EXTREMES], rel=5e-5)
    cells = next(c for c in Cells((run / "report.html").read_text(encoding="utf-8")).rows["extremes"] if c[0] == "motor.moment")
    assert cells[1] == "N·m"
    assert [float(cell) for cell in cells[2::2][:2] + cells[6:]] == pytest.approx(
        [row[key] for key in ("least", "greatest", "mean", "rms")], rel=5e-5
    )


def test_sweep(gudgeon):
    """sweep.csv and cases.csv against sweep.h5."""
    text = DECK.read_text(encoding="utf-8").replace('"../', f'"{ROOT}/inputs/../')
    text = changed(changed(text, "analysis.dynamic", end="3 ms"), "output", figures=None)
    text += "\n[sweep]\nc = 0.5 0.2 mm\n[ensemble]\nruns = 2\nposition = 1e-9 m\n[statistics]\nchannels = motor.moment\n"
    directory = scratch()
    call(gudgeon, "sweep", written(directory, text), "--out", directory / "out", "--quiet", "--jobs", "1")
    runs, cases = (list(csv.DictReader((directory / "out" / name).open())) for name in ("sweep.csv", "cases.csv"))
    with h5py.File(directory / "out" / "sweep.h5") as file:
        names = [name.decode() for name in file["runs/names"]]
        units = [unit.decode() for unit in file["runs/units"]]
        heads = [name if unit == "1" else f"{name} [{unit}]" for name, unit in zip(names, units)]
        for row, values in zip(runs, file["runs/values"]):
            assert [float(row[head] or "nan") for head in heads] == pytest.approx(list(values), rel=0, abs=0, nan_ok=True)
        assert [float(row["motor.moment.rms mean [N.m]"]) for row in cases] == list(file["cases/mean"][:, names.index("motor.moment.rms")])
    assert [row["exit_code"] for row in runs] == ["0"] * 4 and [row["runs"] for row in cases] == ["2", "2"]
