"""Wear over many cycles: a shaft in a bush against closed forms, the interval, the spread of k, resumed lives, what is refused."""

import functools
import json
import math
import shutil

import h5py
import numpy as np
import pytest
from support import ROOT, assert_close, call, scratch, written

BUSH = (ROOT / "inputs/worn_bush.deck").read_text()
PIN = """
deck = 1
[scene]
title = "pin that hops"
gravity = 0 0 m/s^2
[bodies]
name    mass[kg]   inertia[kg.m^2]   y[mm]   omega[rad/s]
shaft   0.1        1e-5              -0.5    100
[points]
name     body
bush     ground
centre   shaft
[material]
name    young[GPa]   poisson   density[kg/m^3]
steel   207          0.3       7850
[clearance.revolute]
name      bearing   journal   bearing_radius[mm]   clearance[mm]   length[mm]   material   law      wear
pin       bush      centre    10                   0.5             15           steel      spring   dry
[contact.kelvin_voigt]
name     stiffness[N/m]   restitution
spring   1e7              0.1
[wear.archard]
name   bearing[m^2/N]   journal[m^2/N]   WORDS
dry    BEARING          JOURNAL          NUMBERS
[force.point]
name   point    fy
pull   centre   {-100 N - FORCE}
[analysis.dynamic]
start = given
overlap = preload
end   = 1 s
tolerance = 1e-6
[life]
cycle = 2 ms
LIFE
"""


def pin(life, words="cells", numbers="90", force="0 N", bearing="0", journal="1e-15", more=""):
    """The deck of a shaft that turns on a bush."""
    text = PIN.replace("WORDS", words).replace("NUMBERS", numbers).replace("FORCE", force)
    return text.replace("BEARING", bearing).replace("JOURNAL", journal).replace("LIFE", life) + more


def life_of(program, text, *options, expect=0):
    """summary.json of a life, and its directory."""
    directory = scratch()
    call(program, "life", written(directory, text), "--out", directory / "out", "--quiet", *options, expect=expect)
    return json.loads((directory / "out/summary.json").read_text()), directory / "out"


def arcs(radius, shaft, depth):
    """Half angles of the worn arc from the centres of shaft and bush."""
    d = radius - shaft + depth
    a = math.acos((radius**2 - shaft**2 - d**2) / (2 * shaft * d))
    return a, math.atan2(shaft * math.sin(a), d + shaft * math.cos(a))


def volume(radius, shaft, length, depth):
    """Volume of a bush that a shaft has worn to a depth."""
    a, b = arcs(radius, shaft, depth)
    return length * (shaft**2 * (a - math.sin(a) * math.cos(a)) - radius**2 * (b - math.sin(b) * math.cos(b)))


@pytest.mark.parametrize("radius, shaft, first, depth, close, close_arc", [
    (10, 9.5, 10, 16, 3e-2, 3e-2), (10, 9.9, 20, 50, 1e-3, 1.1e-3), (20, 19.7, 20, 60, 1e-3, 1e-3), (10, 9.5, 10, 100, 1e-3, 1e-3),
])
def test_bush(gudgeon, radius, shaft, first, depth, close, close_arc):
    """Time, volume and arc at a depth from a first depth, by default settings: the closed form; what is left is the overlap of the
    surfaces, some 1 um, against what is worn."""
    summary, place = life_of(gudgeon, BUSH, "--set", f"R={radius}mm", "--set", f"r={shaft}mm", "--set", f"first_depth={first}um",
                             "--set", f"depth={depth}um")
    radius, shaft, first, depth = radius * 1e-3, shaft * 1e-3, first * 1e-6, depth * 1e-6
    end = volume(radius, shaft, 15e-3, depth)
    time = (end - volume(radius, shaft, 15e-3, first)) / (1e-15 * 100 * 100 * shaft)
    wear = summary["wear"]["bearing"]
    assert_close(wear["bearing"]["depth_max"]["value"], depth, relative=1e-9, what="depth")
    assert_close(wear["time"], time, relative=close, what="time")
    assert_close(wear["bearing"]["volume"]["value"], end, relative=close, what="volume")
    assert_close(wear["bearing"]["arc"]["value"], 2 * arcs(radius, shaft, depth)[1], relative=close_arc, what="arc")
    assert summary["life"]["profiles"] <= 20, "few simulations under held loads"
    for measure in ("depth_max", "volume", "arc"):
        assert all(value == 0 for value in wear["journal"][measure].values()), "the shaft does not wear"
        assert wear["bearing"][measure]["low"] <= wear["bearing"][measure]["value"] <= wear["bearing"][measure]["high"]
    with h5py.File(place / "life.h5") as file:
        cells = file["wear_profiles/volume"][()].sum()
        distance = file["wear/distance"][0]
        assert file["life_jumps/cycles"][-1] == wear["cycles"]
    first = volume(radius, shaft, 15e-3, first)
    assert_close(cells - first, 1e-15 * 100 * distance, relative=1e-4, what="conservation: k F s")


ONCE = functools.cache(life_of)


@pytest.fixture
def lives(gudgeon):
    """Lives by deck, each found once."""
    return lambda text: ONCE(gudgeon, text)


def test_shaft_only(lives):
    """A shaft that wears under a load fixed in space: its radius shrinks linearly, dr/dt = k omega F/(2 pi L), in few simulations."""
    summary, place = lives(pin("depth = 4 um").replace("cycle = 2 ms", "cycle = 62.8318530718 ms"))
    wear = summary["wear"]["pin"]
    rate = 1e-15 * 100 * 100 / (2 * math.pi * 15e-3)
    assert_close(wear["time"], 4e-6 / rate, relative=1e-2, what="time")
    assert_close(wear["journal"]["arc"]["value"], 2 * math.pi, relative=1e-12, what="arc")
    assert wear["journal"]["volume"]["low"] <= wear["journal"]["volume"]["value"] <= wear["journal"]["volume"]["high"]
    with h5py.File(place / "life.h5") as file:
        depth = file["life_profiles/pin/journal/depth"][-1]
        assert np.ptp(depth) < 5e-2 * depth.mean(), "worn all round"
        time, value = file["life_jumps/time"][()], file["life_jumps/depth_max"][()]
        mine = file["life_jumps/surface"][()] == b"journal"
        assert_close(value[mine], rate * time[mine], absolute=1e-7, what="linear")
    assert summary["life"]["profiles"] < 60


def test_both_wear(gudgeon):
    """Bearing and journal of one coefficient lose the same in every sub-jump, and no cell is filled."""
    _, place = life_of(gudgeon, pin("depth = 4 um", bearing="1e-15"))
    with h5py.File(place / "life.h5") as file:
        volume, side = file["life_jumps/volume"][()], file["life_jumps/surface"][()]
        assert_close(volume[side == b"bearing"], volume[side == b"journal"], relative=1e-12, what="volumes")
        assert len(volume) > 20
        for name in ("bearing", "journal"):
            depth = file[f"life_profiles/pin/{name}/depth"][()]
            assert depth.min() >= 0 and np.diff(depth, axis=0).min() >= 0, "nothing is filled"


def test_spread(gudgeon):
    """With `spread = 2` the range of a measure is that of lives with half and twice the coefficient; of a life, half and twice."""
    life = "cycles = 5e5"
    summary, _ = life_of(gudgeon, pin(life, "spread", "2"))
    rows = {(row["surface"], row["measure"]): row for row in summary["life"]["measures"]}
    for factor, end in ((0.5, "spread_low"), (2, "spread_high")):
        other, _ = life_of(gudgeon, pin(life, journal=f"{factor}e-15"))
        assert_close(rows["journal", "volume"][end], other["wear"]["pin"]["journal"]["volume"]["value"], relative=1e-3, what=end)
    summary, _ = life_of(gudgeon, pin("depth = 1 um", "spread", "2"))
    assert_close(summary["life"]["cycles_spread_low"], summary["wear"]["pin"]["cycles"] / 2, relative=1e-12)
    assert_close(summary["life"]["cycles_spread_high"], summary["wear"]["pin"]["cycles"] * 2, relative=1e-12)


def test_ends(lives):
    """Time, clearance and a condition on a channel end a life, each with its reason."""
    summary, _ = lives(pin("time = 5e3 s"))
    assert summary["life"]["ended_by"] == "number of cycles"
    assert_close(summary["life"]["time"], 5e3, relative=1e-9, what="time")
    depth = summary["wear"]["pin"]["journal"]["depth_max"]["value"]
    summary, _ = lives(pin(f"clearance = {0.5e-3 + depth} m"))
    assert summary["life"]["ended_by"].startswith("clearance")
    assert_close(summary["life"]["time"], 5e3, relative=1e-3, what="time at the same depth")
    summary, _ = lives(pin("depth = 1 mm\nstop = pin.normal_force > 1 N"))
    assert summary["life"]["ended_by"] == "pin.normal_force > 1 N, at the start"
    assert summary["life"]["cycles"] == 0


def test_resume(gudgeon):
    """A life whose journal was cut off continues from there, to the same results; one of another deck starts anew."""
    directory = scratch()
    deck = written(directory, pin("cycles = 2e6"))
    call(gudgeon, "life", deck, "--out", directory / "out", "--quiet")
    whole = json.loads((directory / "out/summary.json").read_text())
    journal = directory / "out/life.runs"
    journal.write_bytes(journal.read_bytes()[: journal.stat().st_size * 2 // 3])
    call(gudgeon, "life", deck, "--out", directory / "out", "--quiet")
    again = json.loads((directory / "out/summary.json").read_text())
    assert 0 < again["made"] < whole["made"]
    assert again["wear"] == whole["wear"] and again["life"] == whole["life"]
    call(gudgeon, "life", deck, "--out", directory / "out", "--quiet")
    assert json.loads((directory / "out/summary.json").read_text())["made"] == 0
    call(gudgeon, "life", deck, "--out", directory / "out", "--quiet", "--tolerance", "1e-6")
    assert json.loads((directory / "out/summary.json").read_text())["made"] > 0


def test_ensemble(gudgeon):
    """Starts in processes of their own give what one process gives; their scatter is in the interval."""
    more = "[ensemble]\nruns = 3\nposition = 10 um\nvelocity = 0.1 m/s\n"
    text = pin("cycles = 1e5\nsettle = 0", more=more)
    one, _ = life_of(gudgeon, text, "--jobs", "1")
    two, _ = life_of(gudgeon, text, "--jobs", "3")
    assert one["wear"] == two["wear"] and one["life"] == two["life"]
    errors = {(row["surface"], row["measure"]): row for row in one["life"]["errors"]}
    assert errors["journal", "volume"]["starts"] > 0
    assert one["life"]["starts"] == 3


@pytest.mark.parametrize("change, options, code, words", [
    (("cycle = 2 ms", "cycle = 1 turns of motor"), (), 3, "unknown driver 'motor' in 'cycle'"),
    (("depth = 1 um", ""), (), 3, "[life] has no limit"),
    (("depth = 1 um", "depth = 1 um\nsettle = 1.5"), (), 3, "'settle' is not a whole number of cycles"),
    (("depth = 1 um", "depth = 1 um\nmeasure = 0.5"), (), 3, "measure"),
    (("depth = 1 um", "stop = pin.nothing > 1 N"), (), 3, "pin.nothing"),
    (("depth = 1 um", "stop = pin.normal_force > 1 m"), (), 3, "wrong dimension in a condition"),
    (("cycle = 2 ms", "cycle = -1 s"), (), 3, "the cycle must be a positive time"),
    (("[life]\ncycle = 2 ms\ndepth = 1 um", ""), (), 2, "the deck has no section [life]"),
    (("wear\npin", "level\npin"), (), 2, "nothing wears"),
    (("[life]", "[life]"), (), 2, "form = book"),
    (("depth = 1 um", "depth = 1 um\nsimulations = 2\ndepth_tolerance = 1e-12 m"), (), 5, "the limit of 2 simulated profiles"),
    (("[life]", "[guards]\nspeed = 1 mm/s\n[life]"), (), 5, "simulation of profile 1 failed"),
])
def test_refused(gudgeon, change, options, code, words):
    """What is wrong is said, with its exit code."""
    directory = scratch()
    text = pin("depth = 1 um").replace(*change)
    if "level" in change[1]:
        text = text.replace("spring   dry", "spring   clearance")
    if "book" in words:
        text = text.replace("wear\npin", "wear   form\npin").replace("spring   dry", "spring   dry   book")
    said = call(gudgeon, "life", written(directory, text), "--out", directory / "out", "--quiet", *options, expect=code)
    assert words in said.stderr


def test_what_was_reached(gudgeon):
    """A life that a limit of simulations ends has the profiles up to there, and says so."""
    directory = scratch()
    text = pin("depth = 100 um\nsimulations = 4")
    call(gudgeon, "life", written(directory, text), "--out", directory / "out", "--quiet", expect=5)
    summary = json.loads((directory / "out/summary.json").read_text())
    assert summary["status"] == "failed" and "simulated profiles" in summary["message"]
    assert summary["wear"]["pin"]["journal"]["depth_max"]["value"] > 0
    assert shutil.which("gnuplot") is None or summary["figures"]


def test_pages(lives):
    """Every dataset of life.h5 and every key of the object `life` stands in the reference."""
    summary, place = lives(pin("time = 5e3 s"))
    page = (ROOT / "docs/reference/output.md").read_text()
    names = []
    with h5py.File(place / "life.h5") as file:
        file.visititems(lambda name, item: names.append(name) if isinstance(item, h5py.Dataset) else None)
    for name in names:
        if name.startswith(("deck", "provenance", "wear")) or "/part_" in name:
            continue
        name = name.replace("pin/journal", "JOINT/SURFACE")
        assert f"`/{name}`" in page, name
    assert all(f"`{key}`" in page for key in summary["life"])


def test_run_has_the_object(gudgeon):
    """summary.json of a run has the object `wear` too, without an interval."""
    directory = scratch()
    call(gudgeon, "run", written(directory, pin("depth = 1 um")), "--out", directory / "out", "--quiet")
    summary = json.loads((directory / "out/summary.json").read_text())
    wear, rows = summary["wear"]["pin"], summary["worn_surfaces"]
    assert wear["cycles"] is None and wear["time"] == 1
    for row in rows:
        for measure in ("depth_max", "volume", "arc"):
            assert wear[row["surface"]][measure] == {"value": row[measure], "low": row[measure], "high": row[measure]}
