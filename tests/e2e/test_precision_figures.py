"""Figures of `gudgeon precision`: the legend beside the panels, every reason of a failure, errors of exactly 0."""

import math
import re

from conftest import ROOT
from support import changed, text_of
from test_precision import compared, ladders, no_figures
from test_precision_ends import REST


def numbers(script, pattern):
    """Numbers that a line of a script has."""
    return [float(number) for number in re.search(pattern, script).groups()]


def test_the_legend_stands_beside_the_panel(gudgeon):
    """However many settings there are: not one entry is upon it, and all of them are on the page."""
    text = no_figures(text_of(ROOT / "inputs" / "hard" / "a02_four_bars_1.deck"))
    text = changed(text, "analysis.dynamic", end="0.1 s") + ladders(finest="1e-5", budget="0 s", perturbation="0", exponent_instants="64")
    study = compared(gudgeon, text, "--methods", "* verner.* adams.* dop853.* bdf.* rock4.*")
    assert study.summary["settings"] >= 35
    for name in ("precision", "precision_views"):
        script = (study.directory / "figures" / f"{name}.gp").read_text(encoding="utf-8")
        key = re.search(r"set key noautotitle at screen (\S+), screen \S+ left top .* maxrows (\d+)", script)
        entries = set(re.findall(r"keyentry .* title '(.*?)'", script))
        right = numbers(script, r"rmargin at screen (\S+)")[0] if name == "precision" else numbers(script, r"margins screen \S+, (\S+), \S+ \S+ spacing")[0]
        assert float(key[1]) > right
        width = numbers(script, r"size (\d+),\d+ font")[0]
        columns = math.ceil(len(entries) / int(key[2]))
        assert columns > 1 and (1 - float(key[1])) * width > 7 * columns * max(map(len, entries)), name


def test_every_reason_is_told_once(gudgeon):
    """Coarse runs violate the constraints by another number each, fine ones have not steps enough: two reasons, all crosses in the panel."""
    text = no_figures(text_of(ROOT / "inputs" / "hard" / "a02_four_bars_1.deck"))
    light = ladders(coarsest="1e-3", finest="1e-9", perturbation="0", exponent_end="1 s")
    free = compared(gudgeon, changed(text, "analysis.dynamic", end="2 s") + light, "--methods", "verner.none").ladder("verner.none")
    most = int(free[-2]["steps"]) - 1
    text = changed(text, "analysis.dynamic", end="2 s", violation_limit="1e-9 m", maximum_steps=most)
    study = compared(gudgeon, text + light, "--methods", "verner.none verner.projection")
    reasons = {re.sub(r"\d[\d.e+-]*", "#", row["reason"]) for row in study.ladder("verner.none") if row["state"] == "failed"}
    assert len(reasons) == 2
    script = (study.directory / "figures" / "precision.gp").read_text(encoding="utf-8")
    notes = " ".join(re.findall(r"set label 1\d '(.*?)' at screen", script))
    assert len(re.findall("verner.none failed: ", notes)) == len(reasons)
    assert "audit failed: a constraint was violated by" in notes and " runs)" in notes
    edge = numbers(script, r"set xrange \[\S+:(\S+?)\]")[0]
    assert numbers(script, r"==2\) \? (\S+) : NaN")[0] == edge


def test_errors_of_nothing_have_a_mark_of_their_own(gudgeon):
    """A mass at rest: every run is exact, and stands at 0, the edge of an axis that has no number there."""
    study = compared(gudgeon, REST + ladders(exponent_instants="64"), "--methods", "verner adams")
    assert all(row["motion"] == 0 for row in study.rows)
    script = (study.directory / "figures" / "precision.gp").read_text(encoding="utf-8")
    place, = numbers(script, r"set xtics add \('0' (\S+)\)")
    assert place == numbers(script, r"set xrange \[(\S+?):")[0] and "zero error" in script
    assert place < 0.2 * min(row["asked"] for row in study.rows)
    data = (study.directory / "figures" / "precision.dat").read_text(encoding="utf-8")
    assert {float(line.split()[1]) for line in data.splitlines() if line and line[0] != "#"} == {place}
    assert "# zero errors are drawn at" in data
    views = (study.directory / "figures" / "precision_views.gp").read_text(encoding="utf-8")
    assert views.count("set ytics add ('0' ") == 1
