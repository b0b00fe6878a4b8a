"""Sweeps and ensembles: the numbers of single runs, however many run at once; failures recorded; nothing lost."""

import csv
import functools
import json
import os
import re
import shutil
import signal
import subprocess
import time

import h5py
import numpy as np
import pytest
from support import DECK, ROOT, Run, assert_close, call, changed, plain, plain_deck, scratch, written

STATISTICS = "\n[statistics]\nafter = 1 ms\nperiod = 1 ms\nchannels = motor.moment\n"
SWEEP = "\n[sweep]\nlaw = hertz lankarani_nikravesh\nc = 0.5 0.2 mm\n"


def short(*sections, end="4 ms"):
    """A short motion of the dry slider-crank, with further sections."""
    return plain_deck([("analysis.dynamic", "end", end), ("output", "every", "20 us")]) + STATISTICS + "".join(sections)


def swept(program, text, *options, expect=0):
    """The directory of a sweep."""
    directory = scratch()
    done = call(program, "sweep", written(directory, text), "--out", directory / "out", "--quiet", *options, expect=expect)
    return directory / "out", done


@functools.lru_cache(maxsize=None)
def four_cases(program, jobs):
    """Two laws times two clearances, with all channels."""
    return swept(program, short(SWEEP, "keep = channels\n"), "--jobs", jobs)[0]


def contents(file):
    """All datasets and attributes of a file as bytes, those that may differ left out."""
    found = {}

    def look(name, node):
        if name.startswith("provenance"):
            return
        if isinstance(node, h5py.Dataset):
            value = plain(node[()])
            found[name] = value.tobytes() if isinstance(value, np.ndarray) else value
        for key, value in node.attrs.items():
            if key not in ("REFERENCE_LIST", "DIMENSION_LIST"):
                found[f"{name}@{key}"] = str(value)

    file.visititems(look)
    return found


def test_a_sweep_gives_the_numbers_of_single_runs(gudgeon):
    """Bit for bit: the statistics, the channels once per period, and all channels."""
    with h5py.File(four_cases(gudgeon, 2) / "sweep.h5") as sweep:
        assert sweep.attrs["filetype"] == "gudgeon sweep"
        assert plain(sweep.attrs["status"]) == "complete"
        cases = [("hertz", 0.5), ("hertz", 0.2), ("lankarani_nikravesh", 0.5), ("lankarani_nikravesh", 0.2)]
        assert_close(sweep["parameters/values"][:, 1], [1e-3 * c for _, c in cases], relative=1e-15)
        assert [text.split()[0] for text in plain(sweep["parameters/texts"][:])] == [law for law, _ in cases]
        for k, (law, c) in enumerate(cases):
            directory = scratch()
            deck = written(directory, short())
            call(gudgeon, "run", deck, "--out", directory / "out", "--quiet", "--set", f"law={law}", "--set", f"c={c}mm")
            run = Run(directory / "out")
            assert sweep["runs/values"][k].tobytes() == run.read("statistics/values").tobytes()
            rows = sweep["strobe/run"][:] == k + 1
            assert sweep["strobe/values"][rows].tobytes() == run.read("statistics/strobe").tobytes()
            for path in ("time", "row_kind", "bodies/velocity", "clearances/force", "energy/residual", "events"):
                if path in sweep[f"channels/{k + 1}"]:
                    assert sweep[f"channels/{k + 1}/{path}"][()].tobytes() == run.rows(path).tobytes() or path == "events", path
            assert "bodies/velocity" in sweep[f"channels/{k + 1}"]


def swept_everywhere():
    """A deck whose parameters stand in rows, laws, expressions of loads, settings, requests, and in each other."""
    text = short(end="2 ms")
    text = text.replace("[parameters]", "[parameters]\nload = 1 N\ndouble = {2*load}\ndigits = 1e-8\nshare = 0.5\n", 1)
    text = text.replace("tolerance   = 1e-8", "tolerance   = {digits}", 1)
    return text + """
[force.point]
name     point   fx
push     pin     {double*sin(2*pi*share*t/1ms)}

[request]
name     value                    unit
power    {share*motor.moment}     N.m
"""


@pytest.mark.parametrize(
    "parameter, values",
    [
        ("c", "0.5 0.2 mm"),
        ("restitution", "0.9 0.5"),
        ("friction", "0.1 0"),
        ("speed", "5000 4000 rpm"),
        ("law", "lankarani_nikravesh hertz"),
        ("load", "1 5 N"),
        ("share", "0.5 0.75"),
        ("digits", "1e-8 1e-6"),
    ],
)
def test_every_case_is_that_of_a_deck_read_anew(gudgeon, parameter, values):
    """Wherever the parameter stands: all channels, and what the deck is said to mean."""
    text = swept_everywhere()
    out, _ = swept(gudgeon, text + f"\n[sweep]\n{parameter} = {values}\nkeep = channels\n", "--jobs", 1)
    words = values.split()
    unit = words.pop() if len(words) == 3 else ""
    with h5py.File(out / "sweep.h5") as sweep:
        for k, word in enumerate(words):
            directory = scratch()
            deck = written(directory, text)
            call(gudgeon, "run", deck, "--out", directory / "out", "--quiet", "--set", f"{parameter}={word}{unit}")
            run = Run(directory / "out")
            kept = sweep[f"channels/{k + 1}"]
            assert "bodies/velocity" in kept
            for path in ("time", "bodies/velocity", "clearances/force", "energy/residual"):
                if path in kept:
                    assert kept[path][()].tobytes() == run.rows(path).tobytes(), (path, word)


def test_the_number_of_jobs_does_not_matter(gudgeon):
    one, two = four_cases(gudgeon, 1), four_cases(gudgeon, 2)
    for name in ("sweep.csv", "cases.csv"):
        assert (one / name).read_bytes() == (two / name).read_bytes()
    with h5py.File(one / "sweep.h5") as a, h5py.File(two / "sweep.h5") as b:
        assert contents(a) == contents(b)


def test_a_failing_case_is_recorded_and_the_rest_goes_on(gudgeon):
    """A clearance larger than the bearing is a mistake of its case only."""
    out, done = swept(gudgeon, short("\n[sweep]\nc = 0.5 20 0.2 mm\n"), expect=8)
    assert "1 of 3 runs failed" in done.stderr
    rows = list(csv.DictReader((out / "sweep.csv").open()))
    assert [row["exit_code"] for row in rows] == ["0", "3", "0"]
    assert "bearing" in rows[1]["message"]
    assert rows[1]["motor.moment.rms [N.m]"] == ""
    assert float(rows[2]["motor.moment.rms [N.m]"]) > 0
    with h5py.File(out / "sweep.h5") as file:
        assert list(file["runs/exit_code"]) == [0, 3, 0]
        assert plain(file.attrs["status"]) == "failed"
        assert np.isnan(file["runs/values"][1]).all()
        assert list(file["cases/runs"]) == [1, 0, 1]
    assert (out / "runs" / "2.log").read_text().startswith("error:")


def ensemble(program, runs, seed, **options):
    """Runs from perturbed starts."""
    settings = "".join(f"{key} = {value}\n" for key, value in options.items())
    out, _ = swept(program, short(f"\n[ensemble]\nruns = {runs}\nseed = {seed}\n{settings}"))
    with h5py.File(out / "sweep.h5") as file:
        return file["runs/values"][:], {name: file[f"cases/{name}"][0] for name in ("mean", "deviation", "min", "max")}


def test_an_ensemble_follows_from_its_seed(gudgeon):
    three, _ = ensemble(gudgeon, 3, 1)
    five, spread = ensemble(gudgeon, 5, 1)
    other, _ = ensemble(gudgeon, 3, 2)
    assert three.tobytes() == five[:3].tobytes()
    assert len({row.tobytes() for row in five} | {row.tobytes() for row in other}) == 8
    assert_close(spread["mean"], five.mean(axis=0), 1e-300, 1e-13)
    assert_close(spread["deviation"], five.std(axis=0, ddof=1), 1e-12 * np.abs(five).max(), 1e-9)
    assert np.array_equal(spread["min"], five.min(axis=0))
    assert np.array_equal(spread["max"], five.max(axis=0))
    still, _ = ensemble(gudgeon, 2, 1, position="0 m", velocity="0 m/s")
    assert still[0].tobytes() == still[1].tobytes()


def test_a_perturbed_start_fulfils_the_constraints(gudgeon):
    """The loose pin is moved by no more than was asked for; the ideal joints and the driver hold."""
    directory = scratch()
    text = short("\n[ensemble]\nruns = 2\nposition = 1 um\nvelocity = 1 mm/s\n", end="2.2 ms")
    text = changed(text, "output", channels="*")
    deck = written(directory, text)
    call(gudgeon, "run", deck, "--out", directory / "base", "--quiet")
    call(gudgeon, "run", deck, "--out", directory / "moved", "--quiet", "--member", 2)
    call(gudgeon, "run", deck, "--out", directory / "none", "--quiet", "--member", 3, expect=2)
    base, moved = Run(directory / "base"), Run(directory / "moved")
    assert moved.read("joints/violation")[0].max() < 1e-12
    assert moved.read("joints/violation_rate")[0].max() < 1e-9
    eccentricity = np.abs(moved.read("clearances/eccentricity")[0] - base.read("clearances/eccentricity")[0])
    assert 1e-8 < eccentricity.max() < 5e-6
    speed = np.abs(moved.read("bodies/velocity")[0] - base.read("bodies/velocity")[0])
    assert 1e-6 < speed.max() < 5e-3


def test_ranges_and_pairs(gudgeon):
    """What the words for values mean, told by the tables of a sweep."""
    out, _ = swept(
        gudgeon,
        short("\n[sweep]\ncombine = paired\nspeed = 1000 .. 5000 rpm in 3\nc = 0.01mm .. 1mm in 3 geometric\n", end="2.2 ms"),
    )
    rows = list(csv.DictReader((out / "sweep.csv").open()))
    assert len(rows) == 3
    assert_close([float(row["speed [rad/s]"]) for row in rows], np.array([1000, 3000, 5000]) * np.pi / 30, relative=1e-15)
    assert_close([float(row["c [m]"]) for row in rows], [1e-5, 1e-4, 1e-3], relative=1e-12)


def test_a_killed_sweep_leaves_what_is_done(gudgeon):
    directory = scratch()
    deck = written(directory, short("\n[sweep]\nc = 0.1 .. 0.5 mm in 200\n", end="200 ms"))
    command = [gudgeon, "sweep", deck, "--out", directory / "out", "--quiet", "--jobs", "2"]
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    file = directory / "out" / "sweep.h5"
    try:
        for _ in range(600):
            time.sleep(0.05)
            assert process.poll() is None, "the sweep ended too early"
            if file.exists():
                break
        assert call(gudgeon, "sweep", deck, "--out", directory / "out", expect=9).stderr.count("is writing to") == 1
    finally:
        os.kill(process.pid, signal.SIGKILL)
        process.wait()
    with h5py.File(file) as sweep:
        codes = sweep["runs/exit_code"][:]
        assert plain(sweep.attrs["status"]) == "running"
        assert (codes == 0).any() and (codes == -1).any()
        assert np.isfinite(sweep["runs/values"][np.argmax(codes == 0)]).any()
    for _ in range(100):  # the runs end with the sweep
        if not left(directory):
            break
        time.sleep(0.05)
    assert not left(directory)
    again = written(directory, short("\n[sweep]\nc = 0.1 mm\n"))
    call(gudgeon, "sweep", again, "--out", directory / "out", "--quiet")
    assert (directory / "out.1" / "sweep.h5").exists()


def merged(program, deck, parts, *options):
    """The directory of a sweep made in parts, the last part first."""
    out = scratch() / "out"
    for part in range(parts, 0, -1):
        call(program, "sweep", deck, "--out", out, "--quiet", "--shard", f"{part}/{parts}", *options)
    call(program, "merge", out, "--quiet")
    return out


@pytest.mark.parametrize("keep", ["numbers", "channels"])
def test_parts_make_the_whole(gudgeon, keep):
    """The same file as of one sweep, whatever the number of parts, even after the deck is gone."""
    whole = four_cases(gudgeon, 1)
    text = short(SWEEP, "keep = channels\n")
    if keep == "numbers":
        text = short(SWEEP)
        whole = swept(gudgeon, text)[0]
    deck = written(scratch(), text)
    for parts in (2, 3):
        out = merged(gudgeon, deck, parts)
        for name in ("sweep.csv", "cases.csv"):
            assert (out / name).read_bytes() == (whole / name).read_bytes()
        with h5py.File(whole / "sweep.h5") as a, h5py.File(out / "sweep.h5") as b:
            assert contents(a) == contents(b)
    deck.write_text("not a deck any more")
    call(gudgeon, "merge", out, "--quiet")


def test_parts_that_are_missing_or_of_another_deck(gudgeon):
    directory = scratch()
    deck = written(directory, short(SWEEP))
    out = directory / "out"
    assert "no shards" in call(gudgeon, "merge", out, expect=9).stderr
    call(gudgeon, "sweep", deck, "--out", out, "--quiet", "--shard", "1/2")
    done = call(gudgeon, "merge", out, expect=8)
    assert "2 of 4 runs are missing" in done.stderr
    assert "2 missing" in done.stdout and "all runs were complete already" not in done.stdout
    with h5py.File(out / "sweep.h5") as file:
        assert list(file["runs/exit_code"]) == [0, -1, 0, -1]
    deck = written(directory, short(SWEEP, end="5 ms"))
    call(gudgeon, "sweep", deck, "--out", out, "--quiet", "--shard", "2/2")
    assert "differ in: file " in call(gudgeon, "merge", out, expect=2).stderr
    assert "as 3/20" in call(gudgeon, "sweep", deck, "--shard", "3/2", expect=2).stderr
    assert "as 3/20" in call(gudgeon, "sweep", deck, "--shard", "3", expect=2).stderr


def test_a_sweep_goes_on_where_it_was_killed(gudgeon):
    """Only what is missing is made; the file is that of a sweep that nothing disturbed."""
    text = short("\n[sweep]\nc = 0.1 .. 0.5 mm in 60\n", end="20 ms")
    whole = swept(gudgeon, text)[0]
    directory = scratch()
    deck = written(directory, text)
    command = [gudgeon, "sweep", deck, "--out", directory / "out", "--quiet", "--jobs", "1"]
    process = subprocess.Popen(command)
    journal = directory / "out" / "sweep.runs"
    for _ in range(4000):
        time.sleep(0.005)
        if journal.exists() and journal.read_bytes().count(b"motor.moment.rms") >= 10:
            break
    process.kill()
    process.wait()
    with open(journal, "ab") as file:  # a block that was cut off
        file.write(journal.read_bytes()[-50:-20])
    done = call(gudgeon, "sweep", deck, "--out", directory / "out", "--json").stdout
    assert 1 <= json.loads(done)["made"] <= 50
    with h5py.File(whole / "sweep.h5") as a, h5py.File(directory / "out" / "sweep.h5") as b:
        assert contents(a) == contents(b)
    assert json.loads(call(gudgeon, "sweep", deck, "--out", directory / "out", "--json").stdout)["made"] == 0
    assert not (directory / "out.1").exists()


def test_a_directory_that_vanishes(gudgeon, tmp_path):
    """Exit code 9 at once, and not a sweep of runs that failed."""
    deck = written(tmp_path, short("\n[sweep]\nc = 0.1mm .. 0.5mm in 400\n", end="10 ms"))
    out = tmp_path / "out"
    process = subprocess.Popen([gudgeon, "sweep", deck, "--out", out, "--quiet"], stderr=subprocess.PIPE, text=True)
    while process.poll() is None and not (out / "sweep.h5").exists():
        time.sleep(0.01)
    while process.poll() is None and out.exists():
        shutil.rmtree(out, ignore_errors=True)
    said = process.communicate(timeout=60)[1]
    assert process.returncode == 9 and str(out) in said, said


def test_a_deck_edited_meanwhile_changes_nothing(gudgeon):
    """All rows are of the deck as it was at the beginning, and a warning names what changed."""
    text = short("\n[sweep]\nc = 0.1 .. 0.5 mm in 40\n", end="20 ms")
    whole = swept(gudgeon, text)[0]
    directory = scratch()
    written(directory, text, "base.deck")
    deck = written(directory, 'deck = 1\ninclude "base.deck"\n')
    process = subprocess.Popen([gudgeon, "sweep", deck, "--out", directory / "out", "--quiet", "--jobs", "1"])
    for _ in range(4000):
        time.sleep(0.005)
        if (directory / "out" / "sweep.h5").exists():
            break
    written(directory, text.replace("restitution = 0.9", "restitution = 0.5"), "base.deck")
    assert process.wait() == 0
    assert (whole / "sweep.csv").read_bytes() == (directory / "out" / "sweep.csv").read_bytes()
    assert "base.deck changed during the sweep" in (directory / "out" / "summary.txt").read_text()


def test_cases_from_a_file(gudgeon):
    """A row is a case; with further parameters every combination."""
    directory = scratch()
    written(directory, "# of the bench\nc [mm], law, restitution\n0.5, hertz, 0.9\n\n0.2, lankarani_nikravesh, 0.8 # soft\n",
            "cases.csv")
    deck = written(directory, short('\n[sweep]\nfile = "cases.csv"\nspeed = 4000 5000 rpm\n'))
    call(gudgeon, "sweep", deck, "--out", directory / "out", "--quiet")
    rows = list(csv.DictReader((directory / "out" / "sweep.csv").open()))
    assert [(row["law"], float(row["c [m]"]), float(row["restitution"])) for row in rows] == \
        [("hertz", 5e-4, 0.9)] * 2 + [("lankarani_nikravesh", 2e-4, 0.8)] * 2
    assert_close([float(row["speed [rad/s]"]) for row in rows], np.array([4000, 5000, 4000, 5000]) * np.pi / 30, relative=1e-15)
    alone = short()
    call(gudgeon, "run", written(directory, alone, "alone.deck"), "--out", directory / "alone", "--quiet", "--set", "c=0.2mm",
         "--set", "restitution=0.8", "--set", "speed=5000rpm")
    with h5py.File(directory / "out" / "sweep.h5") as file:
        assert file["runs/values"][3].tobytes() == Run(directory / "alone").read("statistics/values").tobytes()


@pytest.mark.parametrize(
    "table, words",
    [
        ("cc[mm]\n1\n", "did you mean 'c'"),
        ("c[mm]\n1 2\n", "has 2 cells"),
        ("c[mm],law\n1,\n", "empty cell"),
        ("c[kg]\n1\n", "this is a mass"),
        ("c[mm]\nx\n", "is not a number"),
        ("law\n3\n", "not a word"),
        ("law\nherz\n", "unknown"),
        ("c[mm]\n", "has 0 rows"),
        ("c[mm];c[mm]\n1;2\n", "swept twice"),
        ("c[mm]\n1\n", "swept twice"),
    ],
)
def test_mistakes_of_a_file_of_cases(gudgeon, table, words):
    directory = scratch()
    written(directory, table, "cases.txt")
    more = "c = 1 mm\n" if words == "swept twice" and ";" not in table else ""
    deck = written(directory, DECK.read_text() + f'\n[sweep]\nfile = "cases.txt"\n{more}')
    done = call(gudgeon, "sweep", deck, "--out", directory / "out", expect=3)
    assert words in done.stderr, done.stderr


def test_a_sweep_through_a_pipe(gudgeon):
    directory = scratch()
    done = subprocess.run([gudgeon, "sweep", "/dev/stdin", "--out", directory / "out", "--quiet"], input=short(SWEEP), text=True)
    assert done.returncode == 0
    assert len((directory / "out" / "sweep.csv").read_text().splitlines()) == 5


def left(directory):
    """Processes that still work for a directory."""
    found = []
    for name in os.listdir("/proc"):
        if name.isdigit():
            try:
                with open(f"/proc/{name}/cmdline", "rb") as file:
                    line = file.read()
            except OSError:
                continue
            if str(directory).encode() in line and b"gudgeon" in line:
                found.append(name)
    return found


@pytest.mark.parametrize("values, is_log", [("0.01mm .. 0.5mm in 5", False), ("0.01mm .. 0.5mm in 5 geometric", True)])
def test_the_axis_of_a_range(gudgeon, values, is_log):
    """Values at equal distances stand so in the figure, however far they go; a geometric range at equal distances of its logarithm."""
    text = changed(short(f"\n[sweep]\nc = {values}\n", end="2.2 ms"), "output", figures="bifurcation(motor.moment)")
    out, _ = swept(gudgeon, text)
    assert ("set logscale x" in (out / "figures" / "bifurcation.motor.moment.gp").read_text()) == is_log


def test_figures_of_a_sweep(gudgeon):
    """Numbers with their spread, and the channel once per period, over the first parameter; one curve for each of the second."""
    text = changed(
        short("\n[sweep]\nc = 0.5 0.2 mm\nrestitution = 0.9 1\n[ensemble]\nruns = 2\n", end="3 ms"),
        "output",
        figures="bifurcation(motor.moment) statistics(motor.moment.rms,gudgeon.contact_fraction)",
    )
    out, _ = swept(gudgeon, text)
    names = sorted(path.name for path in (out / "figures").glob("*.png"))
    assert names == ["bifurcation.motor.moment.png", "statistics.motor.moment.rms.gudgeon.contact_fraction.png"]
    rows = np.loadtxt((out / "figures" / names[1].replace("png", "dat")).read_text().splitlines()[4:])
    with h5py.File(out / "sweep.h5") as file:
        at = list(plain(file["runs/names"][:])).index("motor.moment.rms")
        assert np.array_equal(rows[:, 0], [5e-4, 2e-4, 5e-4, 2e-4])
        assert_close(rows[:, 1], file["cases/mean"][:, at][[0, 2, 1, 3]], relative=1e-15)
        assert_close(rows[:, 2], file["cases/deviation"][:, at][[0, 2, 1, 3]], relative=1e-15)
        assert len(file["strobe/time"]) == 8 * 3
        text = (ROOT / "docs/reference/output.md").read_text()
        found = [f"/{group}/{name}" for group, node in file.items() if isinstance(node, h5py.Group) for name in node]
        found = {re.sub(r"part_[0-9]+$", "part_*", name) for name in found}
        assert [name for name in found if f"`{name}`" not in text] == []


@pytest.mark.parametrize(
    "lines, words",
    [
        ("cc = 1 mm", "did you mean 'c'"),
        ("c = 1 2 kg", "this is a mass"),
        ("c = 1 .. 2 mm", "invalid range of 'c'"),
        ("c = 0 .. 2 mm in 3 geometric", "must not include zero"),
        ("c = 1mm .. 2m in 3", "invalid range of 'c'"),
        ("law = 3", "not a word"),
        ("law = hertz herz", "unknown"),
        ("combine = zipped\nc = 1 mm", "grid"),
        ("combine = paired\nc = 1 2 mm\nfriction = 0 0.1 0.2", "paired parameters need equal numbers of values"),
        ("c = 1 mm\nc = 2 mm", "swept twice"),
        ("keep = numbers", "the sweep has no parameters"),
    ],
)
def test_mistakes_of_a_sweep(gudgeon, lines, words):
    done = call(gudgeon, "check", written(scratch(), DECK.read_text() + f"\n[sweep]\n{lines}\n"), expect=3)
    assert words in done.stderr, done.stderr


def test_requests_that_make_no_sense(gudgeon):
    directory = scratch()
    deck = written(directory, short(SWEEP))
    assert "is swept by the deck" in call(gudgeon, "sweep", deck, "--set", "c=1mm", expect=2).stderr
    assert "neither" in call(gudgeon, "sweep", DECK, expect=2).stderr
    assert "number from 1 on" in call(gudgeon, "sweep", deck, "--jobs", "0", expect=2).stderr
    assert "a sweep of 4 cases" in call(gudgeon, "check", deck).stdout
    done = call(gudgeon, "run", deck, "--out", directory / "out")
    assert "'gudgeon sweep' runs the cases" in done.stdout


def test_a_deck_overrides_what_it_includes(gudgeon):
    """Keys of the deck itself win over those of the same section in an included file; twice in one file is a mistake."""
    directory = scratch()
    written(directory, DECK.read_text(), "base.deck")
    deck = written(directory, 'deck = 1\ninclude "base.deck"\n[analysis.dynamic]\nend = 3 ms\n')
    call(gudgeon, "run", deck, "--out", directory / "out", "--quiet", "--write", "numbers")
    assert Run(directory / "out").summary["time_end"] == 3e-3
    assert Run(directory / "out").summary["tolerance"] == 1e-8
    deck = written(directory, 'deck = 1\ninclude "base.deck"\n[analysis.dynamic]\nend = 3 ms\n[analysis.dynamic]\nend = 4 ms\n')
    assert "is given twice" in call(gudgeon, "check", deck, expect=3).stderr


def test_a_deck_that_overrides_is_overridden(gudgeon):
    """Of a key the file nearest to the deck wins, whatever the order of the lines; files beside one another are no order."""
    directory = scratch()
    written(directory, DECK.read_text(), "base.deck")
    written(directory, 'deck = 1\n[scene]\ntitle = "Middle"\n[analysis.dynamic]\nend = 3 ms\ninclude "base.deck"\n', "middle.deck")
    text = 'deck = 1\n[analysis.dynamic]\nend = 2 ms\ninclude "middle.deck"\ninclude "base.deck"\n'
    deck = written(directory, text)
    call(gudgeon, "run", deck, "--out", directory / "out", "--quiet", "--write", "numbers")
    summary = Run(directory / "out").summary
    assert (summary["time_end"], summary["title"], summary["tolerance"]) == (2e-3, "Middle", 1e-8)
    written(directory, '[analysis.dynamic]\nend = 4 ms\n[scene]\ntitle = "Beside"\n', "beside.inc")
    call(gudgeon, "check", written(directory, text + 'include "beside.inc"\n[scene]\ntitle = "Top"\n'))
    done = call(gudgeon, "check", written(directory, text + 'include "beside.inc"\n'), expect=3)
    assert "key 'title' is given twice in section scene" in done.stderr and "'end'" not in done.stderr


def test_figures_of_a_sweep_with_missing_runs(gudgeon):
    """Of two curves all runs of the second are missing: the first is drawn, and gnuplot has nothing to say."""
    directory = scratch()
    text = changed(short("\n[sweep]\nc = 0.5 0.2 mm\nlaw = hertz lankarani_nikravesh\n"), "output",
                   figures="bifurcation(motor.moment) statistics(motor.moment.rms)")
    deck = written(directory, text)
    call(gudgeon, "sweep", deck, "--out", directory / "out", "--quiet", "--shard", "1/2")
    done = call(gudgeon, "merge", directory / "out", expect=8)
    assert "gnuplot" not in done.stdout + done.stderr
    script = (directory / "out" / "figures" / "bifurcation.motor.moment.gp").read_text()
    assert (directory / "out" / "figures" / "bifurcation.motor.moment.png").stat().st_size > 3000
    assert "law = hertz" in script and "lankarani" not in script


@pytest.mark.parametrize(("values", "factor", "unit"), (("1000 .. 5000 rpm in 3", 60 / (2 * np.pi), "rpm"),
                                                         ("100rad/s 5000rpm", 1.0, "rad/s")))
def test_abscissa_in_the_unit_of_the_deck(gudgeon, values, factor, unit):
    """Speeds in rpm stand at round numbers of rpm; values of different units have one that reads well."""
    text = changed(short(f"\n[sweep]\nspeed = {values}\n", end="2.2 ms"), "output", figures="bifurcation(motor.moment)")
    out, _ = swept(gudgeon, text)
    script = (out / "figures" / "bifurcation.motor.moment.gp").read_text(encoding="utf-8")
    assert f"set xlabel 'speed [{unit}]'" in script
    scale = script.split("using ", 1)[1].split(":")[0].strip("()").removeprefix("$1").removeprefix("*") or "1"
    assert_close(float(scale), factor, relative=1e-5)
