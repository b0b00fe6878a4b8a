"""One peak, one value: summary, statistics, sweep, compare, --accuracy, report and reader tell the same greatest force of a run.

The references are the places themselves, the same motion with a hundred times as many output instants, and a closed form.
"""

import csv
import json
import math
import os
import re

import numpy as np
import pytest
from conftest import ROOT
from support import Run, assert_close, call, changed, scratch, text_of, written

STATIC = {"journal_bearing", "hanging_chain"}  # decks that run statically too; here they run dynamically
FEW = {"double_pendulum", "impact", "slider_crank_6_6_lubricated", "slider_crank_dry", "slider_crank_lubricated", "four_bar_kinematic", "valve_train"}
DECKS = [path for path in sorted((ROOT / "inputs").glob("*.deck")) if "[analysis.dynamic]" in text_of(path)]
KINEMATIC = [path for path in sorted((ROOT / "inputs").glob("*.deck")) if "[analysis.kinematic]" in text_of(path)]
if "GUDGEON_ALL_DECKS" not in os.environ:  # set by `make stability`: all decks of inputs/ take minutes
    DECKS, KINEMATIC = ([path for path in paths if path.stem in FEW] for paths in (DECKS, KINEMATIC))
END = {"bouncing_ball": "1.2 s", "double_pendulum": "0.5 s", "gate": "3 s", "journal_bearing": "0.1 s", "slider_crank_6_6_lubricated": "8 ms",
       "slider_crank_dry": "12 ms", "slider_crank_lubricated": "24 ms"}  # of long motions
FORCES = ("N", "N.m")


@pytest.fixture
def reader(root, monkeypatch):
    monkeypatch.syspath_prepend(str(root / "scripts/python"))
    from gudgeon import reader

    return reader


def text_of_deck(path, analysis="dynamic", **output):
    """A deck with all channels, no figures, and statistics of the whole motion."""
    text = re.sub(r'(?m)^(\s*include\s+)"([^"]+)"', lambda found: f'{found.group(1)}"{path.parent / found.group(2)}"', path.read_text())
    text = re.sub(r'"([\w./]+\.txt)"', lambda found: f'"{path.parent / found.group(1)}"', text)
    for section in ("statistics", "sweep", "ensemble"):
        text = re.sub(rf"(?ms)^\[{section}\].*?(?=^\[|\Z)", "", text)
    text = changed(text, "output", figures=None, channels="*", **{"from": None, "last": None}, **output)
    if path.stem in END:
        text = changed(text, f"analysis.{analysis}", end=END[path.stem])
    return text


def run_of(gudgeon, text, *options):
    directory = scratch()
    call(gudgeon, "run", written(directory, text), "--write", "channels", "--quiet", "--out", directory / "out", *options)
    return Run(directory / "out")


def greatest(entry):
    return max(abs(entry["least"]), abs(entry["greatest"]))


def forces_of(run):
    """Greatest magnitudes of the forces of a run that are not round-off, by channel."""
    found = {e["channel"]: greatest(e) for e in run.summary["extremes"] if e["unit"] in FORCES and e["least"] is not None}
    largest = max(found.values(), default=0.0)
    return {name: value for name, value in found.items() if value > 1e-6 * largest}


@pytest.mark.slow
@pytest.mark.parametrize("deck", DECKS, ids=lambda path: path.stem)
def test_seven_places(gudgeon, reader, deck):
    text = text_of_deck(deck)
    first = run_of(gudgeon, text)
    forces = forces_of(first)
    if not forces:
        pytest.skip("no forces are recorded")
    name = max(forces, key=forces.get)
    text = changed(text, "output", report="on")
    text += f"\n[statistics]\nafter = 0 s\nchannels = {name}\n\n[parameters]\nnothing_at_all = 1\n\n[sweep]\nnothing_at_all = 1 2\n"
    directory = scratch()
    path = written(directory, text)
    call(gudgeon, "run", path, "--quiet", "--write", "all", "--out", directory / "out")
    run = Run(directory / "out")
    entry = next(e for e in run.summary["extremes"] if e["channel"] == name)
    peak = greatest(entry)
    assert peak == forces[name]
    # statistics
    assert run.summary["statistics"][f"{name}.peak"] == peak
    # reader
    assert reader.read(directory / "out").peak(name)[0] == peak
    assert reader.read(directory / "out", rows="all").peak(name)[0] == peak
    # compare
    call(gudgeon, "compare", directory / "out", directory / "out", "--quiet", "--out", directory / "compared")
    with (directory / "compared/compare.csv").open() as file:
        row = next(row for row in csv.DictReader(file) if row["channel"] == name)
    assert float(row["peak_a"]) == float(row["peak_b"]) == peak
    # report: five digits in a unit that suits them
    page = (directory / "out/report.html").read_text()
    page = page[page.index('id="extremes"') :]
    cells = re.search(rf"<tr><td>{re.escape(name)}</td>(.*?)</tr>", page).group(1)
    cells = re.findall(r"<td>(.*?)</td>", cells)
    factor = {"n": 1e-9, "μ": 1e-6, "m": 1e-3, "k": 1e3, "M": 1e6}.get(re.split(r"[N·]", cells[0])[0], 1.0)
    assert_close(max(abs(float(cells[1])), abs(float(cells[3]))) * factor, peak, relative=1e-4, what="report")
    # sweep
    call(gudgeon, "sweep", path, "--quiet", "--out", directory / "sweep")
    with next((directory / "sweep").glob("*.csv")).open() as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    column = next(key for key in rows[0] if key.startswith(f"{name}.peak"))
    assert_close(float(rows[0][column]), peak, relative=1e-12, what="sweep")
    # joints with contacts: the table of joints, the events, the channel
    for joint in run.summary["loose_joints"]:
        of = [e for e in run.summary["extremes"] if re.fullmatch(rf"{re.escape(joint['joint'])}(\.\w+)?\.normal_force", e["channel"])]
        if of and joint["impacts"] > 0 and joint["peak_force"]:
            assert_close(max(map(greatest, of)), joint["peak_force"], relative=1e-6, what=joint["joint"])


@pytest.mark.slow
@pytest.mark.parametrize(
    "name, end", [("four_bar", "60 ms"), ("double_pendulum", "20 ms"), ("slider_crank_dry", None), ("crosshead", "15 ms")]
)
def test_accuracy_tells_the_same(gudgeon, name, end):
    """Up to an end that the accuracy asked for reaches: beyond it, `--accuracy` tells the extremes of the time before."""
    text = text_of_deck(ROOT / f"inputs/{name}.deck")
    if end:
        text = changed(text, "analysis.dynamic", end=end)
    directory = scratch()
    path = written(directory, text)
    call(gudgeon, "run", path, "--accuracy", "1e-3", "--write", "channels", "--quiet", "--out", directory / "out", expect=None)
    run = Run(directory / "out")
    told = {e["name"]: e for e in run.summary["accuracy"]["extremes"]}
    of_run = {e["channel"]: e for e in run.summary["extremes"]}
    assert run.summary["accuracy"]["claim"] in ("end", "reached")
    compared = 0
    for channel, extreme in told.items():
        if "contact_point" in channel or extreme["max"] is None:
            continue
        compared += 1
        for here, there in (("min", "least"), ("max", "greatest")):
            assert_close(extreme[here], of_run[channel][there], absolute=max(extreme["error"], 1e-9 * extreme["scale"]), what=channel)
    assert compared > 5


@pytest.mark.slow
@pytest.mark.parametrize("deck", DECKS + KINEMATIC, ids=lambda path: path.stem)
def test_greatest_force_does_not_depend_on_every(gudgeon, deck):
    analysis = "kinematic" if deck in KINEMATIC else "dynamic"
    text = text_of_deck(deck, analysis)
    every = re.search(r"(?m)^every\s*=\s*([\d.]+)\s*(\w+)", text)
    coarse = run_of(gudgeon, text, "--analysis", analysis)
    part = 5 if deck in KINEMATIC else 100  # each instant of a kinematic analysis is a solution of its own
    fine = run_of(gudgeon, changed(text, "output", every=f"{float(every.group(1)) / part:.9g} {every.group(2)}"), "--analysis", analysis)
    forces = forces_of(coarse)
    finer = forces_of(fine)
    name = max(finer, key=finer.get)
    assert_close(forces[name], finer[name], relative=1e-6, what=name)


def test_pendulum_by_energy(gudgeon):
    """The greatest reaction of a pendulum let go from a right angle, three times its weight, whatever output instants there are."""
    text = """deck = 1
[scene]
title = "pendulum"
space = planar
gravity = 0 -10 m/s^2
[bodies]
name mass[kg] inertia[kg.m^2] x[m] y[m]
bob  2        1e-12           1    0
[points]
name body xi[m] eta[m]
o ground 0 0
p bob -1 0
[joint.revolute]
name i j
pivot o p
[analysis.dynamic]
end = 3 s
tolerance = 1e-11
[output]
every = {every}
channels = *
"""
    for every in ("70 ms", "7 ms"):
        run = run_of(gudgeon, text.replace("{every}", every))
        entry = next(e for e in run.summary["extremes"] if e["channel"] == "pivot.force.y")
        assert_close(greatest(entry), 60.0, relative=1e-6, what=every)


def test_every_maximum_of_a_long_contact_has_a_row(gudgeon):
    """A ball that is pressed onto a stiff plane swings in it for ever: each maximum, located in between, has a row of its own."""
    text = """deck = 1
[scene]
title = "ball on a plane"
space = planar
gravity = 0 -10 m/s^2
[bodies]
name mass[kg] inertia[kg.m^2] x[m] y[m]
ball 1 1e-2 0 0.1
[points]
name body xi[m] eta[m]
o ground 0 0
c ball 0 0
[material]
name young[GPa] poisson density[kg/m^3]
steel 200 0.3 7850
[contact.kelvin_voigt]
name stiffness[N/m] restitution
spring 1e5 1
[clearance.plane]
name plane ball axis radius[m] material law
floor o c y 0.1 steel spring
[analysis.dynamic]
end = 0.1 s
tolerance = 1e-10
[output]
every = 50 ms
channels = *
"""
    run = run_of(gudgeon, text)
    omega = math.sqrt(1e5)
    expected = np.arange(math.pi, 0.1 * omega, 2 * math.pi) / omega  # from the overlap of nothing: 1 - cos
    time, kind = run.rows("time"), run.rows("row_kind")
    peaks = time[kind == 2]
    assert len(peaks) >= 3
    for t in expected:
        assert np.abs(peaks - t).min() < 1e-6


def test_both_sides_of_a_jump(gudgeon):
    """A kinematic slide at rest until t0, then x = A (exp(-k u) - 1 + k u): the acceleration jumps from 0 to A k^2 and falls, between outputs."""
    text = """deck = 1
[scene]
title = "slide"
space = planar
gravity = 0 0 m/s^2
[bodies]
name mass[kg] inertia[kg.m^2] x[m] y[m]
block 2 1e-2 0 0
[points]
name body xi[m] eta[m]
o ground 0 0
c block 0 0
[joint.translational]
name i j axis
rail o c x
[driver.position]
name i j axis position
ram o c x {0.3m*(exp(-40/1s*max(t - 0.0531s, 0s)) - 1 + 40/1s*max(t - 0.0531s, 0s))}
[analysis.kinematic]
end = 0.1 s
[output]
every = 10 ms
channels = *
"""
    run = run_of(gudgeon, text)
    entry = next(e for e in run.summary["extremes"] if e["channel"] == "block.acceleration.x")
    assert_close(entry["greatest"], 0.3 * 40**2, relative=1e-9, what="acceleration")
    assert entry["least"] == 0 and entry["greatest_time"] == pytest.approx(0.0531, abs=1e-9)
    force = next(e for e in run.summary["extremes"] if e["channel"] == "ram.force")
    assert_close(greatest(force), 2 * 0.3 * 40**2, relative=1e-9, what="force")
