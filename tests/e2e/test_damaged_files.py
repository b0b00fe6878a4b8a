"""Damaged files: a checkpoint, a run.h5 and the journal of a sweep in which bits were flipped, bytes set to zero, or which were cut off.

Each is refused with words, or what comes of it is what came of the whole file, to the bit. GUDGEON_DAMAGED=300 makes so many of each kind.
"""

import functools
import os
import random
import shutil
import signal
import subprocess

import numpy as np
import pytest
from support import Run, answer_signals, call, plain_deck, scratch, written
from test_restart import begun
from test_sweep import SWEEP, contents, short

import h5py

MANY = int(os.environ.get("GUDGEON_DAMAGED", "15"))
ENDS = (0, 1, 2, 3, 4, 5, 6, 7, 8, 9)  # exit codes with words
SAID = ("damaged", "checksum", "recorded in the checkpoint", "cannot", "no ", "not ", "anew", "differ")


def damaged(content, rng):
    """One of the ways in which files are damaged, so that something is another."""
    whole, content = content, bytearray(content)
    how, at = rng.randrange(4), rng.randrange(len(content))
    if how <= 1:
        content[at] ^= 1 << rng.randrange(8)
    elif how == 2:
        length = rng.choice((1, 8, 64, 512, 4096))
        content[at:at + length] = bytes(len(content[at:at + length]))
    else:
        del content[at:]
    return bytes(content) if bytes(content) != whole else damaged(whole, rng)


def ended(program, *arguments):
    """How a command ends: never by a signal, never without an end; with words if not with 0."""
    done = subprocess.run([str(program), *map(str, arguments)], capture_output=True, text=True, errors="replace", timeout=120,
                          stdin=subprocess.DEVNULL)
    assert done.returncode in ENDS, (done.returncode, done.stderr[-2000:])
    if done.returncode:
        assert any(word in done.stderr for word in SAID), done.stderr[-2000:]
        assert "Backtrace" not in done.stderr
    return done.returncode


def numbers(path):
    """All of a run.h5 but what differs from run to run."""
    with h5py.File(path) as file:
        found = contents(file)
    return {name: value for name, value in found.items() if "cpu" not in name and "clock" not in name and "elapsed" not in name}


@functools.lru_cache(maxsize=None)
def stopped_run(program, killed):
    """The directory of a run that was stopped or killed, its deck, and the rows of the run that nobody disturbed."""
    place = scratch()
    deck = written(place, plain_deck((("analysis.dynamic", "checkpoint", "1 ms"), ("output", "every", "2 us"),
                                      ("output", "channels", "slider.velocity gudgeon.*"))))
    call(program, "run", deck, "--out", place / "whole", "--quiet")
    process = begun(program, deck, place / "out")
    process.send_signal(signal.SIGKILL if killed else signal.SIGTERM)
    process.communicate(timeout=60)
    assert process.returncode in ((-signal.SIGKILL,) if killed else (7,)), "the run ended before it was stopped"
    return place, deck, rows_of(place / "whole")


def rows_of(directory):
    """The rows of a run, as bytes."""
    run = Run(directory)
    return [run.rows(name).tobytes() for name in ("time", "row_kind", "bodies/velocity", "clearances/contacts/normal_force")] + [run.contacts.tobytes()]


@pytest.mark.parametrize("name", ("checkpoint.h5", "run.h5"))
@pytest.mark.parametrize("killed", (False, True))
def test_a_run_does_not_go_on_from_damage(gudgeon, name, killed):
    """What is resumed is the run that nobody disturbed, or is refused."""
    place, deck, whole = stopped_run(gudgeon, killed)
    rng = random.Random(f"{name} {killed}")
    content = (place / "out" / name).read_bytes()
    ends = []
    for k in range((MANY + 1)//2):
        again = place / f"again{k}"
        shutil.copytree(place / "out", again)
        (again / name).write_bytes(damaged(content, rng) if k else content)
        ends.append(ended(gudgeon, "run", deck, "--out", again, "--resume", "--quiet"))
        if ends[-1] == 0:
            assert rows_of(again) == whole, k
        shutil.rmtree(again)
        shutil.rmtree(f"{again}.1", ignore_errors=True)
    assert ends[0] == 0, "what is not damaged goes on"
    assert any(ends[1:])
    if name == "checkpoint.h5":
        assert all(ends[1:]), "every damage of a checkpoint is found"


@pytest.mark.parametrize("killed", (False, True))
def test_a_damaged_run_is_not_compared(gudgeon, killed):
    """Equal to the run that it was made from, or refused: never a crash. The rows of a killed run have no checksum: they may differ."""
    place, _, _ = stopped_run(gudgeon, killed)
    rng = random.Random(f"compared {killed}")
    whole = place / "out" / "run.h5"
    content = whole.read_bytes()
    for k in range((MANY + 1)//2):
        broken = place / "broken.h5"
        broken.write_bytes(damaged(content, rng) if k else content)
        end = ended(gudgeon, "compare", whole, broken, "--out", place / "compared", "--quiet")
        assert end == 0 or k > 0
        assert end != 1 or killed, "no checksum was missed"


def test_a_damaged_journal_of_a_sweep(gudgeon):
    """Runs that a damaged journal does not have are made again: the tables of the sweep are the same."""
    place = scratch()
    deck = written(place, short(SWEEP, end="2 ms"))
    call(gudgeon, "sweep", deck, "--out", place / "whole", "--quiet")
    content = (place / "whole" / "sweep.runs").read_bytes()
    rng = random.Random("sweep")
    for k in range(MANY):
        again = place / f"again{k}"
        shutil.copytree(place / "whole", again)
        (again / "sweep.runs").write_bytes(damaged(content, rng))
        if ended(gudgeon, "sweep", deck, "--out", again, "--quiet") == 0:
            for name in ("sweep.csv", "cases.csv"):
                assert (again / name).read_bytes() == (place / "whole" / name).read_bytes(), k
        shutil.rmtree(again)
        shutil.rmtree(f"{again}.1", ignore_errors=True)


def test_files_are_read_by_others_with_their_checksum(gudgeon):
    """The last line of a file that is complete; a library finds it behind its data."""
    place, _, _ = stopped_run(gudgeon, False)
    for name in ("run.h5", "checkpoint.h5"):
        content = (place / "out" / name).read_bytes()
        assert content[-35:].startswith(b"\ngudgeon checksum ") and content.endswith(b"\n"), name
        with h5py.File(place / "out" / name) as file:
            assert len(file) > 2
    assert np.all(np.diff(Run(place / "out").rows("time")) >= 0)
