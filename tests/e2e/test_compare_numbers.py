"""gudgeon compare where numbers are missing, do not go on smoothly, or do not change: the verdict, the counts, the peaks, the pictures."""

import csv
import functools
import json
import re

import numpy as np
from support import call, changed, plain_deck, scratch, written
from test_compare import PENDULUM

# The rod's angle falls from 0 to -pi and comes back: `half` is a number while it is above -1 rad, `none` never.
REQUESTS = """
[request]
name   value                        unit
half   {{3*sqrt({half} + rod.angle)}}   1
none   {{3*sqrt({none} + rod.angle)}}   1
fixed  {{3*(1 + {noise}*sin(40*rod.angle))}}   1
"""
ASKED = "channels = rod.position.x request.half request.none request.fixed"


@functools.cache
def pendulums(program):
    """Runs whose requests have numbers throughout, or in part, or nowhere."""
    folder = scratch()
    text = PENDULUM.replace("channels = rod.position rod.velocity rod.angle", ASKED)
    for name, half, none, noise in (("all", 100, 100, 0), ("part", 1, -100, 1e-15), ("near", 1, 100, 1e-5)):
        deck = written(folder, text + REQUESTS.format(half=half, none=none, noise=noise), name + ".deck")
        call(program, "run", deck, "--quiet", "--out", name, cwd=folder)
    return folder


def compared(program, folder, a, b, *options, expect):
    """What compare found, channel by channel, all that it found, and what it said; summary.json says the same."""
    out = scratch()
    said = call(program, "compare", a, b, "--out", out, *options, cwd=folder, expect=expect).stdout
    found = json.loads((out / "summary.json").read_text())
    return {channel["channel"]: channel for channel in found["channels"]}, found, said, out


def test_numbers_of_one_alone_are_a_difference(gudgeon):
    """A number on one side only differs, and is counted; peaks are of each one's own numbers."""
    folder = pendulums(gudgeon)
    channels, found, said, out = compared(gudgeon, folder, "all", "part", "--relative", "10", expect=1)
    half, none = channels["request.half"], channels["request.none"]
    assert found["instants"] == 201 and found["different"] == 2 and half["differs"] and none["differs"]
    assert half["only_a"] > 100 and half["only_a"] + half["instants"] == 201
    assert half["only_b"] == half["neither"] == half["unsettled"] == 0
    assert f"differs  ({half['instants']} times compared, value only in A at {half['only_a']})" in said
    assert "differs  (0 times compared, value only in A at 201)" in said
    assert abs(none["peak_a"] - 30) < 1e-9 and none["peak_b"] is None and abs(none["allowed"] - 300) < 1e-8
    assert none["rms"] is None and none["mean_b"] is None and none["mean_a"] > 29
    assert {"figures/request.half.png", "figures/request.none.png"} <= set(found["figures"]) and not found["warnings"]
    script = (out / "figures" / "request.none.gp").read_text(encoding="utf-8")
    assert script.count("\nplot ") == 1 and "A: all/run.h5" in script and "B: part/run.h5" not in script
    row = next(r for r in csv.DictReader((out / "compare.csv").open()) if r["channel"] == "request.half")
    assert [row[key] for key in ("only_a", "only_b", "neither", "unsettled")] == [str(half["only_a"]), "0", "0", "0"]
    back, _, said, _ = compared(gudgeon, folder, "part", "all", "--relative", "10", "--channel", "request.half", expect=1)
    assert back["request.half"]["only_b"] == half["only_a"] and f"value only in B at {half['only_a']}" in said


def test_where_none_has_a_number_they_are_equal(gudgeon):
    """It is told how many instants were compared; what has no number at all has no picture, and a warning says so."""
    folder = pendulums(gudgeon)
    channels, found, said, _ = compared(gudgeon, folder, "part", "part", "--relative", "0", expect=0)
    half, none = channels["request.half"], channels["request.none"]
    assert half["neither"] == 201 - half["instants"] > 100 and not half["differs"]
    assert none["neither"] == 201 and none["instants"] == 0 and not none["differs"]
    assert f"({half['instants']} times compared, in neither at {half['neither']})" in said
    assert found["warnings"] == ["no figure of request.none: no values in A or B"]
    assert "figures/request.half.png" in found["figures"]


def test_numbers_begin_and_end_between_rows(gudgeon):
    """At other instants than its own A is interpolated from numbers alone; where it has none on one side it is not compared."""
    folder = pendulums(gudgeon)
    deck = (folder / "part.deck").read_text()
    other = written(folder, changed(deck, "output", every="7 ms"), "other.deck")
    call(gudgeon, "run", other, "--quiet", "--out", "other", cwd=folder)
    channels, _, said, _ = compared(gudgeon, folder, "part", "other", "--channel", "request.half", "--absolute", "0.3", expect=0)
    half = channels["request.half"]
    assert half["only_a"] == half["only_b"] == 0 and 1 <= half["unsettled"] <= 4 and half["neither"] > 100
    assert half["instants"] + half["neither"] + half["unsettled"] == 286
    assert f"A changes between its rows at {half['unsettled']}" in said


def test_most_of_a_column_is_missing(gudgeon):
    """6 of 8 numbers of a file are none; with --statistics only a side without any number differs for that."""
    folder = pendulums(gudgeon)
    (folder / "few.csv").write_text("t,x\n" + "".join(f"{0.1 * k},{0.5 if k in (0, 4) else 'nan'}\n" for k in range(8)))
    asked = ("--channel", "rod.position.x=x", "--absolute", "1")
    channels, found, said, out = compared(gudgeon, folder, "all", "few.csv", *asked, expect=1)
    x = channels["rod.position.x"]
    assert x["instants"] == 2 and x["only_a"] == 6 and "(2 times compared, value only in A at 6)" in said
    assert found["figures"] == ["figures/rod.position.x.png"]
    assert " with linespoints " in (out / "figures" / "rod.position.x.gp").read_text(encoding="utf-8")
    channels, _, _, _ = compared(gudgeon, folder, "all", "few.csv", *asked, "--statistics", expect=0)
    assert abs(channels["rod.position.x"]["mean_b"] - 0.5) < 1e-12
    (folder / "none.csv").write_text("t,x\n" + "".join(f"{0.1 * k},nan\n" for k in range(8)))
    for options in ((), ("--statistics",)):
        channels, _, _, _ = compared(gudgeon, folder, "all", "none.csv", *asked, *options, expect=1)
        assert channels["rod.position.x"]["peak_b"] is None and abs(channels["rod.position.x"]["peak_a"] - 0.5) < 1e-12


def test_states_and_angles_that_jump(gudgeon):
    """A state is no polynomial, and an angle from -pi to pi is compared modulo a turn; peaks are those of the rows."""
    folder = scratch()
    for every in (20, 33):
        text = plain_deck([("output", "every", f"{every} us"), ("output", "channels", "gudgeon.state gudgeon.contact_angle")])
        call(gudgeon, "run", written(folder, text, f"{every}.deck"), "--quiet", "--out", f"r{every}", cwd=folder)
    channels, found, said, out = compared(gudgeon, folder, "r20", "r33", "--absolute", "0.2", "--relative", "0", expect=0)
    state, angle = channels["gudgeon.state"], channels["gudgeon.contact_angle"]
    assert state["peak_a"] == state["peak_b"] == 1 and state["greatest"] == 0 and state["interpolation"] == 0
    assert 0 < state["unsettled"] < 100 and state["instants"] + state["unsettled"] == found["instants"]
    assert state["only_a"] == state["only_b"] == state["neither"] == 0
    drawn = np.genfromtxt(out / "figures" / "gudgeon.state.dat", comments="#")
    assert set(drawn[:, 1]) == {0, 1} and np.isnan(drawn[:, 3]).sum() == state["unsettled"]
    assert 3 < angle["peak_a"] <= np.pi and 3 < angle["peak_b"] <= np.pi and angle["greatest"] < 0.1
    compared(gudgeon, folder, "r20", "r20", "--relative", "0", expect=0)
    asked = ("--channel", "gudgeon.contact_angle = modulo=0")
    channels, _, _, _ = compared(gudgeon, folder, "r20", "r33", *asked, "--absolute", "0.2", "--relative", "0", expect=1)
    assert channels["gudgeon.contact_angle"]["greatest"] > 1


def test_pictures_line_up(gudgeon):
    """Both panels have the same margins; round-off of a constant is a line, and ticks that differ late have their digits."""
    folder = pendulums(gudgeon)
    scripts = {}
    for b in ("part", "near"):
        _, _, _, out = compared(gudgeon, folder, "all", b, expect=1)
        scripts[b] = (out / "figures" / "request.fixed.gp").read_text(encoding="utf-8")
    for script in scripts.values():
        before = script[: script.index("set multiplot")]
        assert re.search(r"set lmargin at screen [\d.]+; set rmargin at screen [\d.]+", before) and script.count("margin") == 2
    first = scripts["part"].split("\nplot ")[0]
    assert "set yrange [2.7:3.3]" in first
    first = scripts["near"].split("\nplot ")[0]
    assert re.search(r"set ytics [\dEe.-]+; set format y '%\.5f'", first) and "yrange [2.7" not in first
