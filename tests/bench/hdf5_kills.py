"""What is left of an HDF5 file whose writer is killed or finds the disk full: HDF5's own means beside those of run.h5.

    python3 tests/bench/hdf5_kills.py [--build build] [--kills N]

A writer appends blocks of rows to 40 datasets and flushes after each block: in the earliest format, in the latest, and in the latest
as a single writer with multiple readers (SWMR), each by the library's driver `sec2`; and `gudgeon run` by its own driver. Each is ended
by a SIGKILL before one of its writes, at N places evenly over all of them (tests/e2e/end_at_write.c), and by files that may not grow beyond
N sizes. What is left is opened and every dataset read: `none` there is no HDF5 file yet, `refused` it cannot be opened or read, `wrong`
a dataset that is as long as the time or longer holds other numbers than were written, `short` one is shorter than the time, else `right`.
"""

import argparse
import collections
import os
import pathlib
import resource
import signal
import subprocess
import sys
import tempfile

import h5py
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "e2e"))
from support import plain_deck  # noqa: E402

BLOCK, BLOCKS, SETS = 512, 30, 40
WAYS = ("earliest", "latest", "swmr")


def expected(k, first, last):
    """Rows of dataset k of a writer; dataset 0 is the time."""
    rows = np.arange(first, last, dtype=float) + 1.0
    return rows if k == 0 else np.column_stack([rows * (k + j / 8.0) for j in range(3)])


def write(way, path):
    """The writer."""
    with h5py.File(path, "w", libver="earliest" if way == "earliest" else "latest") as file:
        sets = []
        for k in range(SETS):
            shape = () if k == 0 else (3,)
            name = "time" if k == 0 else f"group_{k % 4}/channel_{k}"
            sets.append(file.create_dataset(name, (0, *shape), "f8", maxshape=(None, *shape), chunks=(BLOCK, *shape)))
            sets[-1].attrs["unit"] = "m"
        file.flush()
        if way == "swmr":
            file.swmr_mode = True
        for block in range(BLOCKS):
            for k in range(SETS - 1, -1, -1):  # the time last: what is as long as it should be there
                sets[k].resize((block + 1) * BLOCK, axis=0)
                sets[k][block * BLOCK :] = expected(k, block * BLOCK, (block + 1) * BLOCK)
            file.flush()


def outcome(path, whole, **how):
    """What is left, in one word."""
    if not path.exists() or path.stat().st_size == 0:
        return "none"
    try:
        with h5py.File(path, "r", **how) as file:
            times = file["time"][()]
            n = len(times)
            if n and times[-1] != whole["time"][n - 1]:  # gudgeon ends a run that fails with a row of its own
                n -= 1
            for name, numbers in whole.items():
                values = file[name][()]
                if len(values) < n:
                    return "short"
                if not np.array_equal(values[:n], numbers[:n], equal_nan=True):
                    return "wrong"
    except (OSError, RuntimeError, KeyError) as failure:
        return "none" if "signature not found" in str(failure) else "refused"
    return "right"


def run(command, at=None, size=None):
    """The writer's process, killed at a write, or with a limit of the size of files."""
    env = {**os.environ, "LD_PRELOAD": str(SHIM)} | ({"GUDGEON_KILL_AT": str(at)} if at else {})

    def limit():
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))

    return subprocess.run(command, env=env, capture_output=True, text=True, preexec_fn=limit if size else None)


def main():
    """Measure and print."""
    global SHIM
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build")
    parser.add_argument("--kills", type=int, default=100)
    parser.add_argument("--write", nargs=2, metavar=("WAY", "FILE"), help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.write:
        return write(*options.write)
    with tempfile.TemporaryDirectory() as place:
        place = pathlib.Path(place)
        SHIM = place / "end_at_write.so"
        subprocess.run(["cc", "-shared", "-fPIC", "-o", SHIM, ROOT / "tests" / "e2e" / "end_at_write.c", "-ldl"], check=True)
        deck = place / "scene.deck"
        deck.write_text(plain_deck((("analysis.dynamic", "end", "30 ms"), ("output", "every", "4 us"))))
        print(f"HDF5 {h5py.version.hdf5_version}")
        print(f"{'writer':24}{'ended by':12}{'writes':>8}" + "".join(f"{word:>9}" for word in ("none", "refused", "wrong", "short", "right")))
        for way in (*WAYS, "gudgeon"):
            out = place / way
            path = out / "run.h5"
            out.mkdir()
            command = [sys.executable, "-B", __file__, "--write", way, path]
            if way == "gudgeon":
                command = [options.build / "gudgeon", "run", deck, "--out", out, "--quiet"]
            writes = run(command).stderr.count("write to run.h5")
            with h5py.File(path) as file:
                n, whole = len(file["time"]), {}
                file.visititems(lambda name, node: whole.update({name: node[()]}) if len(getattr(node, "shape", ())) and len(node) == n else None)
            whole_size = path.stat().st_size
            opened = [("", {})] + ([(", opened as SWMR", {"swmr": True})] if way == "swmr" else [])
            for cause in ("kill", "full disk"):
                counts = [collections.Counter() for _ in opened]
                for k in range(options.kills):
                    path.unlink(missing_ok=True)
                    part = (k + 0.5) / options.kills
                    if cause == "kill":
                        run(command, at=max(1, round(part * writes)))
                    else:
                        run(command, size=max(4096, round(part * whole_size)))
                    for count, (_, how) in zip(counts, opened):
                        count[outcome(path, whole, **how)] += 1
                for count, (word, _) in zip(counts, opened):
                    print(f"{way + word:24}{cause:12}{writes:8}" + "".join(f"{count[word]:9}" for word in ("none", "refused", "wrong", "short", "right")),
                          flush=True)


if __name__ == "__main__":
    main()
