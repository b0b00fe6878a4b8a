"""gudgeon compare: a run against columns of an independent program (scipy) and against other runs; --legacy and explain --adams."""

import csv
import functools
import json
import re

import numpy as np
from scipy.integrate import solve_ivp
from support import DECK, call, plain_deck, scratch, written

PENDULUM = """deck = 1
[scene]
title = "Pendulum"
gravity = 0 -9.81 m/s^2
[bodies]
name mass[kg] inertia[kg.m^2] x[m] y[m] angle[deg]
rod 1 0.08333333333333333 0.5 0 0
[points]
name body xi[m] eta[m]
wall ground 0 0
top rod -0.5 0
[joint.revolute]
name i j
pin wall top
[analysis.dynamic]
end = 2 s
tolerance = 1e-12
[output]
every = 10 ms
channels = rod.position rod.velocity rod.angle
"""


@functools.cache
def pendulum(program):
    """The run, in a folder of its own."""
    folder = scratch()
    call(program, "run", written(folder, PENDULUM, "pend.deck"), "--quiet", cwd=folder)
    return folder


def independent():
    """The same pendulum by scipy: time, x, y, angle at other instants."""
    t = np.arange(150) * 0.013
    angle = solve_ivp(
        lambda _, y: [y[1], -1.5 * 9.81 * np.cos(y[0])], (0, 2), [0, 0], method="DOP853", rtol=1e-13, atol=1e-13, t_eval=t
    ).y[0]
    return t, 0.5 * np.cos(angle), 0.5 * np.sin(angle), angle


def compared(program, folder, file, *options, expect):
    """What compare found, channel by channel."""
    done = call(program, "compare", "outputs/pend", file, "--json", *options, cwd=folder, expect=expect)
    found = json.loads(done.stdout)
    return {channel["channel"]: channel for channel in found["channels"]}, found


ASKED = (
    "--time", "1 shift=-5ms", "--channel", "rod.position.x=PX", "--channel", "rod.position.y=3 scale=-1",
    "--channel", "rod.angle=ANGLE", "--absolute", "1e-8", "--relative", "0",
)


def test_a_planted_difference_is_found_and_no_other(gudgeon):
    """1e-6 m at one instant of 150, in a file with its own units, sign, time shift and instants."""
    folder = pendulum(gudgeon)
    t, x, y, angle = independent()
    for planted in (0.0, 1e-6):
        moved = x.copy()
        moved[77] += planted
        table = np.c_[1e3 * t + 5, 1e3 * moved, -1e3 * y, np.degrees(angle)]
        np.savetxt(folder / "legacy.csv", table, delimiter=",", header="T (ms),PX [mm],PY [mm],ANGLE (deg)", comments="", fmt="%.15g")
        channels, found = compared(gudgeon, folder, "legacy.csv", *ASKED, expect=1 if planted else 0)
        assert found["different"] == (1 if planted else 0)
        assert [c for c in channels if channels[c]["differs"]] == (["rod.position.x"] if planted else [])
        assert channels["rod.angle"]["greatest"] < 1e-8
        if planted:
            assert abs(channels["rod.position.x"]["greatest"] - 1e-6) < 1e-8
            assert abs(channels["rod.position.x"]["at"] - t[77]) < 1e-9
            assert abs(channels["rod.position.x"]["rms"] - 1e-6 / np.sqrt(150)) < 1e-9
    rows = list(csv.DictReader((folder / "outputs" / "pend_compare" / "compare.csv").open()))
    assert [r["channel"] for r in rows if r["differs"] == "1"] == ["rod.position.x"]
    picture = folder / "outputs" / "pend_compare" / "figures" / "rod.position.x.png"
    assert picture.read_bytes()[:4] == b"\x89PNG"


def test_shifted_and_turned_columns(gudgeon):
    """A late signal has its lag, a larger one its magnitude; a frame that is turned comes back; a table of Adams with two requests."""
    folder = pendulum(gudgeon)
    t, x, y, angle = independent()
    late = solve_ivp(
        lambda _, s: [s[1], -1.5 * 9.81 * np.cos(s[0])], (0, 2), [0, 0], method="DOP853", rtol=1e-12, atol=1e-12, dense_output=True
    ).sol(np.maximum(t - 0.004, 0))[0]
    np.savetxt(folder / "late.txt", np.c_[t, late, 1.25 * angle])
    channels, _ = compared(gudgeon, folder, "late.txt", "--channel", "rod.angle=2", expect=1)
    assert abs(channels["rod.angle"]["lag"] - 0.004) < 2e-4
    channels, _ = compared(gudgeon, folder, "late.txt", "--channel", "rod.angle=3", expect=1)
    assert abs(channels["rod.angle"]["magnitude"] - 0.25) < 1e-8
    assert channels["rod.angle"]["phase"] < 1e-6
    c, s = np.cos(np.radians(30)), np.sin(np.radians(30))
    lines = ["REQUEST 1", "TIME X Y"] + [f"{a:.12E} {b:.12E} {d:.12E}".replace("E", "D") for a, b, d in zip(t, t, t)]
    lines += ["REQUEST 2", "TIME X Y"] + [f"{a:.15g}  {c * b + s * d:.15g}  {-s * b + c * d:.15g}" for a, b, d in zip(t, x, y)]
    (folder / "request.tab").write_text("\n".join(lines) + "\n")
    spec = "rod.position = X Y turn=30deg absolute=1e-7 relative=0"
    _, found = compared(gudgeon, folder, "request.tab:2", "--channel", spec, expect=0)
    assert found["different"] == 0
    (folder / "what.txt").write_text(f"# channels\ntime = TIME\n{spec}\n")
    compared(gudgeon, folder, "request.tab:2", "--table", "what.txt", expect=0)
    compared(gudgeon, folder, "request.tab:1", "--table", "what.txt", expect=1)
    wrapped = np.degrees(np.arctan2(np.sin(angle), np.cos(angle)))
    np.savetxt(folder / "wrapped.txt", np.c_[t, wrapped])
    compared(gudgeon, folder, "wrapped.txt", "--channel", "rod.angle=2 unit=deg modulo=360deg", "--relative", "1e-7", expect=0)


def test_own_files_as_columns(gudgeon):
    """A .dat file of the run itself has the names of its channels."""
    folder = pendulum(gudgeon)
    channels, found = compared(gudgeon, folder, "outputs/pend/rod.dat", "--relative", "1e-13", "--absolute", "1e-14", expect=0)
    assert len(channels) == 5 and found["different"] == 0


def test_requests_and_points_are_compared(gudgeon):
    """Channels of requests and of named points are channels like any other; rows of contacts in a file of the run are not compared."""
    folder = scratch()
    text = plain_deck([("analysis.dynamic", "end", "4 ms"), ("output", "every", "20 us"), ("output", "channels", "slider.position request.twice small.*")])
    text = text.replace("[parameters]", "[parameters]\nfactor = 2", 1)
    deck = written(folder, text + "\n[request]\nname  value  unit\ntwice  {factor*slider.position.x}  m\n")
    for name, factor in (("a", "2"), ("b", "3")):
        call(gudgeon, "run", deck, "--set", f"factor={factor}", "--out", folder / "outputs" / name, "--quiet")
    done = call(gudgeon, "compare", folder / "outputs" / "a", folder / "outputs" / "b", "--json", expect=1, cwd=folder)
    found = json.loads(done.stdout)
    names = {entry["channel"] for entry in found["channels"]}
    assert {"request.twice", "small.position.x", "small.velocity.y", "slider.position.x"} <= names and found["different"] == 1
    own = call(gudgeon, "compare", folder / "outputs" / "a", folder / "outputs" / "a" / "slider.dat", "--json", expect=0, cwd=folder)
    assert json.loads(own.stdout)["different"] == 0


def test_runs_against_each_other(gudgeon):
    """Settings that differ, impacts in pairs; --legacy takes fixed steps and the book's procedures; statistics of a chaotic motion."""
    folder = scratch()
    deck = written(folder, plain_deck((("output", "channels", "slider.velocity gudgeon.*"),)), "dry.deck")
    for name, options in (("a", ()), ("p1", ("--legacy", "procedure1")), ("p2", ("--legacy", "procedure2"))):
        call(gudgeon, "run", deck, "--quiet", "--out", name, *options, cwd=folder)
    echo = (folder / "p2" / "deck.echo").read_text()
    assert re.search(r"contact_onset\s*= reject", echo) and re.search(r"coordinates\s*= full", echo)
    call(gudgeon, "compare", "a", "a", "--relative", "0", "--out", "same", cwd=folder)
    for name in ("p1", "p2"):
        done = call(gudgeon, "compare", "a", name, "--json", "--out", "c", "--channel", "slider.velocity.x", cwd=folder, expect=1)
        impacts = json.loads(done.stdout)["impacts"]
        assert [i["number"] for i in impacts] == list(range(1, 11))
        assert all(abs(i["onset_b"] - i["onset_a"]) < 2e-6 for i in impacts[:4])
        assert all(abs(i["peak_force_b"] / i["peak_force_a"] - 1) < 0.05 for i in impacts[:4])
    done = call(gudgeon, "compare", "a", "p1", "--statistics", "--json", "--out", "c", "--channel", "slider.velocity.x", cwd=folder)
    channel = json.loads(done.stdout)["channels"][0]
    assert channel["mean_significance"] > 0.05 and not channel["differs"]


def test_adams_parameters_of_a_law(gudgeon):
    """Of the law of Hunt and Crossley's kind the elastic part is IMPACT's own; at 1 m/s the impact parts with the restitution."""
    said = call(gudgeon, "explain", DECK, "--adams").stdout
    part = said[said.index("Adams: F") :]
    assert "k = 6.6102e10 N/m^e, e = 1.5" in part
    pairs = re.findall(r"restitution ([\d.]+) \(law: ([\d.]+)\)", part)
    assert len(pairs) == 3
    assert abs(float(pairs[1][0]) - float(pairs[1][1])) < 0.01
    off = [float(x) for x in re.findall(r"force differs by up to ([\d.]+) %", part)]
    assert off[1] < 1 < min(off[0], off[2])  # damping of IMPACT does not go with the impact speed


def test_decimal_commas_gaps_and_further_tables(gudgeon):
    """A comma is a decimal point where semicolons or tabs part the numbers; a number that is missing is none; what is not read is told."""
    folder = pendulum(gudgeon)
    t, x, y, _ = independent()
    rows = [[f"{number:.17g}" for number in row] for row in zip(t, x, y)]
    for name, sign, mark in (("comma.csv", ";", ","), ("tab.txt", "\t", ","), ("point.csv", ";", ".")):
        (folder / name).write_text("".join(sign.join(row).replace(".", mark) + "\n" for row in rows))
        found, _ = compared(gudgeon, folder, name, "--channel", "rod.position.y=3", "--absolute", "1e-8", expect=0)
        assert found["rod.position.y"]["greatest"] < 3e-9, name
    gaps = [list(row) for row in rows]
    gaps[5][2] = ""
    gaps[7][1] = ""
    (folder / "gaps.csv").write_text("t,x,y\n" + "".join(",".join(row) + "\n" for row in gaps))
    found, _ = compared(gudgeon, folder, "gaps.csv", "--channel", "rod.position.y=y", "--absolute", "1e-8", expect=1)
    assert found["rod.position.y"]["instants"] == len(t) - 1 and found["rod.position.y"]["only_a"] == 1
    (folder / "torn.csv").write_text("".join((",".join(row) + ("" if k != 9 else ",8,8")) + "\n" for k, row in enumerate(rows)))
    done = call(gudgeon, "compare", "outputs/pend", "torn.csv", "--channel", "rod.position.y=3", "--absolute", "1e-8", cwd=folder)
    assert "'torn.csv' has 3 tables; this comparison uses the first, 9 rows from line 1 on; the second is torn.csv:2, from line 10" in done.stdout


def test_columns_never_touch(gudgeon):
    """A magnitude of -0.00082 has eight characters: a blank stands between all columns, as in the line of their names."""
    folder = pendulum(gudgeon)
    t, _, y, angle = independent()
    np.savetxt(folder / "long.csv", np.c_[t, y * (1 - 0.00082), angle * (1 + 0.00082), y * -1.00082e-150], delimiter=",")
    asked = [word for k, name in enumerate(("rod.position.y", "rod.angle", "rod.velocity.y"), 2) for word in ("--channel", f"{name}={k}")]
    lines = call(gudgeon, "compare", "outputs/pend", "long.csv", *asked, cwd=folder, expect=1).stdout.splitlines()
    head = next(k for k, line in enumerate(lines) if line.startswith("channel "))
    assert lines[head].replace(" [s]", "").split() == "channel RMS maximum at tolerance peak A peak B lag magn. phase".split()
    ends = [at.end() for at in re.finditer(r"\S(?:\S| \S)*", lines[head])][1:]
    for row in lines[head + 1 : head + 4]:
        cells = row.split("]", 1)[1].split()
        assert len(cells) == 10 and cells[-1] == "differs", row
        [float(cell) for cell in cells[:-1] if cell != "-"]
        assert all(row[at - 1] != " " and row[at] == " " for at in ends), (lines[head], row)
    assert any(" -0.00082 " in row for row in lines)


def test_mistakes_have_messages(gudgeon):
    folder = pendulum(gudgeon)
    np.savetxt(folder / "two.csv", np.c_[np.arange(5.0), np.arange(5.0)], delimiter=",", header="t,q", comments="")
    for options, words in (
        (("rod.angel=2",), "did you mean 'rod.angle'"),
        (("rod.angle=w",), "no column 'w'"),
        (("rod.angle=2 unit=kg",), "does not match"),
        (("rod.angle=2 unite=deg",), "unknown key"),
    ):
        done = call(gudgeon, "compare", "outputs/pend", "two.csv", "--channel", *options, cwd=folder, expect=2)
        assert words in done.stderr
    assert "two arguments" in call(gudgeon, "compare", "outputs/pend", cwd=folder, expect=2).stderr
    call(gudgeon, "compare", "missing", "two.csv", cwd=folder, expect=9)
    call(gudgeon, "compare", "outputs/pend", "missing.csv", cwd=folder, expect=9)
    done = call(gudgeon, "compare", "outputs/pend", "two.csv", "--time", "1 shift=100s", "--channel", "rod.angle=2", cwd=folder, expect=2)
    assert "do not overlap" in done.stderr
