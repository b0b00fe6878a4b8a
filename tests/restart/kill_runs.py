"""Runs that are killed at random moments: all that was written can be read, and a resumed run is the one that nobody disturbed.

    kill_runs.py PROGRAM [--restarts N] [--kills N] [--seed S]

`make kill-test` runs it. Times are random, so that every call tries others; the seed that it prints makes it try the same ones.
"""

import argparse
import json
import os
import pathlib
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

import h5py
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tests" / "e2e"))
from support import changed, plain, text_of  # noqa: E402

# name, deck, settings of [analysis.dynamic]: dry contact, friction that remembers, films, space, methods with a history
DECKS = (
    ("dry", "slider_crank_dry", {"end": "40 ms", "checkpoint": "1.5 ms"}),
    ("friction", "friction", {"checkpoint": "15 ms"}),
    ("films", "slider_crank_lubricated", {"checkpoint": "4 ms"}),
    ("space", "slider_crank_6_6_bushing", {"checkpoint": "4 ms"}),
    ("adams", "double_pendulum", {"method": "adams", "checkpoint": "20 ms"}),
    ("bdf", "slider_crank_dry", {"method": "bdf", "end": "20 ms", "checkpoint": "1.5 ms"}),
)


def contents(path):
    """All datasets and attributes of a file but those of /provenance, by path."""
    found = {}

    def visit(name, node):
        if name.split("/")[0] == "provenance":
            return
        for key, value in node.attrs.items():
            if key not in ("DIMENSION_LIST", "REFERENCE_LIST"):
                found[f"{name}@{key}"] = plain(value)
        if isinstance(node, h5py.Dataset):
            found[name] = node[()]

    with h5py.File(path, "r") as file:
        file.visititems(visit)
        found |= {f"/@{key}": plain(value) for key, value in file.attrs.items()}
    return found


def differences(one, other):
    """Paths of what two runs do not have in common, bit for bit: run.h5, and the text files byte by byte."""
    a, b = contents(one / "run.h5"), contents(other / "run.h5")
    found = [name for name in a.keys() ^ b.keys()]
    for name in a.keys() & b.keys():
        x, y = np.asarray(a[name]), np.asarray(b[name])
        same = x.shape == y.shape and x.dtype == y.dtype
        if not same or (x.tobytes() != y.tobytes() if x.dtype.kind != "O" else not np.array_equal(x, y)):
            found.append(name)
    names = {path.name for directory in (one, other) for path in directory.glob("*.dat")}
    for name in names:
        texts = [directory / name for directory in (one, other)]
        if not all(path.exists() for path in texts) or texts[0].read_bytes() != texts[1].read_bytes():
            found.append(name)
    return sorted(found)


def prepared(directory, deck, settings):
    """A deck without figures, with settings; other files that it reads beside it."""
    text = changed(text_of(ROOT / "inputs" / f"{deck}.deck"), "analysis.dynamic", **settings)
    text = re.sub(r"(?m)^\s*figures *=.*$", "", text)
    path = pathlib.Path(directory) / "scene.deck"
    path.write_text(text)
    return path


def start(program, deck, out, *options):
    """A run in a process of its own."""
    command = [program, "run", deck, "--out", out, "--quiet", *options]
    return subprocess.Popen([str(word) for word in command], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)


def duration(program, deck, out):
    """How long an undisturbed run takes, in seconds."""
    begun = time.monotonic()
    process = start(program, deck, out)
    said = process.communicate()[1]
    assert process.returncode == 0, said
    return time.monotonic() - begun


def interrupted(program, deck, out, moments, rng, signals):
    """A run that gets a signal after each of some times and is resumed, to its end; how often it was hit before that."""
    hits, options = 0, []
    for moment in moments:
        process = start(program, deck, out, *options)
        time.sleep(moment)
        number = rng.choice(signals)
        process.send_signal(number)
        said = process.communicate()[1]
        options = ["--resume"]
        if process.returncode == 0:
            break
        assert process.returncode in (-number, 7), (process.returncode, said)
        hits += 1
        if process.returncode == 7:
            assert json.loads((out / "summary.json").read_text())["status"] == "stopped"
    process = start(program, deck, out, "--resume")
    said = process.communicate()[1]
    assert process.returncode == 0, said
    return hits


def try_restarts(program, n, rng):
    """Kills and other signals at random moments of runs, up to three of one run; each must end as the undisturbed one."""
    done = 0
    while done < n:
        for name, deck, settings in DECKS:
            if done >= n:
                break
            with tempfile.TemporaryDirectory() as directory:
                directory = pathlib.Path(directory)
                path = prepared(directory, deck, settings)
                seconds = duration(program, path, directory / "whole")
                moments = [rng.uniform(0, seconds) for _ in range(rng.choice((1, 1, 2, 3)))]
                signals = rng.choice(((signal.SIGKILL,), (signal.SIGKILL,), (signal.SIGTERM, signal.SIGUSR1, signal.SIGKILL)))
                hits = interrupted(program, path, directory / "again", moments, rng, signals)
                found = differences(directory / "whole", directory / "again")
                print(f"restart {done + 1}: {name}, hit {hits} times: {'equal' if not found else found[:5]}", flush=True)
                assert not found
                done += hits


def has_begun(path):
    """Whether there is a file of HDF5: before its first flush it is empty, or without its first line."""
    return path.exists() and path.open("rb").read(4) == b"\x89HDF"


def try_kills(program, n, rng):
    """Kills of runs that write all the time: every file can be read, and lacks no more than the last block."""
    blocks = []
    with tempfile.TemporaryDirectory() as directory:
        directory = pathlib.Path(directory)
        path = prepared(directory, "slider_crank_dry", {"end": "40 ms"})
        path.write_text(changed(path.read_text(), "output", every="2 us"))
        seconds = duration(program, path, directory / "whole")
        whole = contents(directory / "whole" / "run.h5")
        while len(blocks) < n:
            out = directory / f"killed_{len(blocks)}"
            process = start(program, path, out)
            while process.poll() is None and not has_begun(out / "run.h5"):
                time.sleep(0.002)
            time.sleep(rng.uniform(0, seconds))
            process.send_signal(signal.SIGKILL)
            process.communicate()
            if process.returncode == 0:
                shutil.rmtree(out)
                continue
            found = contents(out / "run.h5")
            rows = len(found["time"])
            for name, values in found.items():
                if name in ("events", "time") or not isinstance(values, np.ndarray) or name not in whole:
                    continue
                if values.ndim == 0 or values.shape[0] < rows or whole[name].shape[1:] != values.shape[1:]:
                    continue
                np.testing.assert_array_equal(values[:rows], whole[name][:rows], err_msg=name)
            # text files have what was written up to a block of 256 rows: run.h5, with one of 128, may lack no more than that
            text = (out / "slider.dat").read_text() if (out / "slider.dat").exists() else ""
            lines = sum(1 for line in text.splitlines() if line[:1] not in ("#", '"'))
            blocks.append(lines - rows)
            assert rows + 256 >= lines, (rows, lines)
            shutil.rmtree(out)
    print(f"kills: {len(blocks)} files of {n} readable; rows behind the text files: at most {max(blocks)}")


def main():
    """The command."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--restarts", type=int, default=20)
    parser.add_argument("--kills", type=int, default=200)
    parser.add_argument("--seed", type=int, default=int.from_bytes(os.urandom(3), "big"))
    words = parser.parse_args()
    print(f"seed {words.seed}")
    rng = random.Random(words.seed)
    program = pathlib.Path(words.program).resolve()
    try_restarts(program, words.restarts, rng)
    try_kills(program, words.kills, rng)


if __name__ == "__main__":
    main()
