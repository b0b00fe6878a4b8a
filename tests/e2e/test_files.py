"""What a run leaves behind: windows, an older run, a run that was killed, the layout of run.h5."""

import atexit
import os
import signal
import subprocess
import time

import h5py
import numpy as np
import pytest
from support import Run, assert_close, call, finished, plain, plain_deck, scratch, written

END = 0.024  # of the deck [s]
LONG = (("analysis.dynamic", "end", "5 s"), ("output", "every", "5 us"))


def start(program, deck, out):
    """A run in the background; returns when it has written something."""
    process = subprocess.Popen(
        [str(program), "run", str(deck), "--out", str(out), "--quiet"], stdout=subprocess.PIPE, stderr=subprocess.PIPE
    )
    atexit.register(process.kill)
    limit = time.monotonic() + 20.0
    while not ((out / "run.h5").exists() and (out / "run.h5").stat().st_size > 200_000):
        assert process.poll() is None, process.communicate()[1].decode(errors="replace")
        if time.monotonic() > limit:
            process.kill()
            raise AssertionError("nothing written in 20 s")
        time.sleep(0.02)
    return process


def test_window_from(gudgeon):
    """`from` leaves out what was before; the motion is the same."""
    method = ("analysis.dynamic", "method", "verner")
    part = finished(gudgeon, changes=(method, ("output", "from", "12 ms")))
    whole = finished(gudgeon, changes=(method,))
    assert_close(part.time[[0, -1]], [0.012, END], absolute=1e-12, what="window")
    assert len(part.time) == 1201
    assert np.array_equal(part.contacts["time"][:5], whole.contacts["time"][:5]), "events are kept, and the same"
    position = whole.item("bodies/position", "slider")[-1201:]
    assert_close(part.item("bodies/position", "slider")[:200], position[:200], absolute=1e-12, what="position")


def test_window_last(gudgeon):
    """`last = 2 turns of motor` of a run of three."""
    run = finished(gudgeon, changes=(
        ("analysis.dynamic", "end", "3 turns of motor"), ("output", "last", "2 turns of motor")))
    assert_close(run.time[[0, -1]], [0.012, 0.036], absolute=1e-11, what="window")
    assert len(run.time) == 2401


def test_end_in_turns(gudgeon):
    """`end = 2 turns of motor` is 24 ms at 5000 rpm."""
    turns, whole = finished(gudgeon, changes=(("analysis.dynamic", "end", "2 turns of motor"),)), finished(gudgeon)
    assert_close(turns.summary["time_end"], END, absolute=1e-13, what="end")
    assert len(turns.time) == len(whole.time)
    assert_close(turns.contacts["time"][:10], whole.contacts["time"][:10], absolute=1e-12, what="onsets")


def test_end_in_turns_of_a_parameter(gudgeon):
    """The number of turns may be a parameter, and the speed another."""
    text = plain_deck([("analysis.dynamic", "end", "{turns} turns of motor")])
    text = text.replace("[parameters]", "[parameters]\nturns = 1", 1)
    out = scratch() / "out"
    deck = written(out.parent, text)
    call(gudgeon, "run", deck, "--out", out, "--quiet", "--set", "turns=0.5", "--set", "speed=2500 rpm")
    assert_close(Run(out).time[-1], 0.012, absolute=1e-13, what="end")


def test_channels_of_the_deck_and_no_others(gudgeon):
    """Only what `channels` asks for is written; without it, everything."""
    with h5py.File(finished(gudgeon).directory / "run.h5", "r") as file:
        assert [plain(n).strip() for n in file["bodies/names"]] == ["slider"]
        assert "angle" not in file["bodies"] and "velocity" in file["bodies"] and "moment" in file["drivers"]
    with h5py.File(finished(gudgeon, changes=(("output", "channels", None),)).directory / "run.h5", "r") as file:
        assert [plain(n).strip() for n in file["bodies/names"]] == ["crank", "rod", "slider"]
        assert "angle" in file["bodies"] and "residual" in file["energy"] and "violation" in file["joints"]


def test_layout_describes_itself(gudgeon):
    """Root attributes, summary, and units, long_name, frame and the time scale of every history."""
    run = finished(gudgeon, changes=(("output", "channels", None),))
    with h5py.File(run.directory / "run.h5", "r") as file:
        assert plain(file.attrs["filetype"]) == "gudgeon run"
        assert list(file.attrs["format_version"]) == [2, 2]
        assert plain(file.attrs["status"]) == "complete"
        for key in ("program_version", "git_sha1", "compiler", "libraries", "status_message"):
            assert key in file.attrs, key
        assert file["summary"].attrs["steps"] == run.summary["steps"]
        n, checked = len(file["time"]), 0

        def visit(name, thing):
            nonlocal checked
            if not isinstance(thing, h5py.Dataset) or name == "time" or thing.shape[:1] != (n,):
                return
            checked += 1
            for key in ("units", "long_name", "frame"):
                assert plain(thing.attrs[key]).strip(), f"{key} of {name}"
            assert thing.dims[0].keys() or len(thing.dims[0]), f"time scale of {name}"
            assert thing.dims[0][0].name == "/time", name

        file.visititems(visit)
        assert checked > 25


def test_killed_run_is_readable(gudgeon):
    """After SIGKILL run.h5 opens, says `running`, and holds what was written; the time grows last, so that others may have more rows."""
    directory = scratch()
    deck = written(directory, plain_deck(LONG))
    process = start(gudgeon, deck, directory / "out")
    process.send_signal(signal.SIGKILL)
    process.wait()
    assert not (directory / "out" / "summary.json").exists()
    killed = Run(directory / "out")
    with h5py.File(killed.directory / "run.h5", "r") as file:
        assert plain(file.attrs["status"]) == "running"
        n = len(file["time"])
        assert n > 500
        assert min(len(file["bodies/position"]), len(file["row_kind"])) >= n
    assert_close(killed.time, 5e-6 * np.arange(len(killed.time)), absolute=1e-12, what="time")
    whole = finished(gudgeon).item("bodies/position", "slider")[:100]
    assert_close(killed.item("bodies/position", "slider")[:200:2], whole, absolute=1e-11, what="position")
    # the dead run's directory is free again, and what it left is kept
    call(gudgeon, "run", written(directory, plain_deck()), "--out", directory / "out", "--quiet")
    with h5py.File(directory / "out.1" / "run.h5", "r") as file:
        assert plain(file.attrs["status"]) == "running"


def test_second_run_at_once_is_refused(gudgeon):
    """Two runs into one directory: the second ends with exit 9, the first does not notice."""
    directory = scratch()
    process = start(gudgeon, written(directory, plain_deck(LONG)), directory / "out")
    try:
        size = (directory / "out" / "run.h5").stat().st_size
        done = call(gudgeon, "run", written(directory, plain_deck(), "b.deck"), "--out", directory / "out", expect=9)
        assert "another run" in done.stderr and str(process.pid) in done.stderr
        assert not (directory / "out.1").exists()
        assert process.poll() is None and (directory / "out" / "run.h5").stat().st_size >= size
    finally:
        process.kill()
        process.wait()


def test_older_run_is_kept(gudgeon):
    """The run that was there becomes NAME.1; the one before that goes; other files are left alone."""
    directory = scratch()
    out = directory / "out"
    deck = written(directory, plain_deck([("analysis.dynamic", "end", "0.2 ms")]))
    for tolerance in ("1e-5", "1e-6", "1e-7"):
        call(gudgeon, "run", deck, "--out", out, "--quiet", "--tolerance", tolerance)
    assert Run(out).summary["tolerance"] == 1e-7
    assert Run(directory / "out.1").summary["tolerance"] == 1e-6
    assert {p.name for p in directory.iterdir() if p.is_dir()} == {"out", "out.1"}
    mine = directory / "mine"
    mine.mkdir()
    (mine / "thesis.tex").write_text("do not touch")
    call(gudgeon, "run", deck, "--out", mine, "--quiet", expect=9)
    assert [p.name for p in mine.iterdir()] == ["thesis.tex"]


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="there is no /dev/full")
def test_full_disk_is_an_error(gudgeon):
    """What cannot be printed is not passed over in silence."""
    deck = written(scratch(), plain_deck([("analysis.dynamic", "end", "0.2 ms")]))
    with open("/dev/full", "w") as full:
        done = subprocess.run(
            [str(gudgeon), "run", str(deck), "--out", str(deck.parent / "out"), "--json"],
            stdout=full, stderr=subprocess.PIPE, timeout=60,
        )
    assert done.returncode == 9
