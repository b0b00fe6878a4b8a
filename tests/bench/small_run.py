"""What a small run costs from start to exit, what sampling adds, and which folder of the sources the instructions are spent in.

The dry slider-crank of two turns, figures off: processor time and greatest memory of the whole process, median and least of several
rounds; with two output instants and one channel, and with those of the deck. With valgrind there, the share of instructions of
each folder of src/ and of each library, of the run with the deck's output.
"""

import argparse
import pathlib
import re
import shutil
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tests" / "e2e"))
from pictures import keep, show  # noqa: E402
from support import cost, plain_deck, written  # noqa: E402

COLUMNS = ("process", "cpu_ms", "least_ms", "memory_mb")
LIMITS = "Bounds: at most 15 ms and 20 MB for the small run."


def folder_of(name):
    """The folder of a source file, as 'mechanics/joints', or the library of a function without one."""
    folder = re.match(r"(?:\./)*src/([^:]+)/", name)
    if folder:
        return folder[1]
    if re.search(r"\.inc:", name):
        return "kernels (included text)"
    library = re.search(r"\[.*/([^/\]]+)\]", name)
    for mark, word in (("H5", "HDF5"), ("gfortran", "libgfortran"), ("ld-linux", "loader")):
        if mark in name:
            return word
    return "libm" if library and library[1].startswith("libm") or "dbl-64" in name else "libc and others"


def shares(command, directory):
    """Instructions of each folder, in percent, the greatest first; None without valgrind."""
    if not shutil.which("valgrind") or not shutil.which("callgrind_annotate"):
        return None
    out = directory / "callgrind.out"
    done = subprocess.run(["valgrind", "--tool=callgrind", f"--callgrind-out-file={out}", *command], capture_output=True, text=True)
    if done.returncode != 0:
        return None
    text = subprocess.run(["callgrind_annotate", "--threshold=100", "--auto=no", str(out)], capture_output=True, text=True, check=True).stdout
    found = {}
    for line in text.splitlines():
        part = re.match(r"\s*([\d,]+) \([\s\d.]+%\)\s+(\S.*)", line)
        if part and part[2] != "PROGRAM TOTALS":
            folder = folder_of(part[2])
            found[folder] = found.get(folder, 0) + int(part[1].replace(",", ""))
    total = sum(found.values())
    return [{"folder": folder, "percent": 100*n/total, "millions": n/1e6} for folder, n in sorted(found.items(), key=lambda item: -item[1])]


def main():
    """Measure, show and keep."""
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--build", type=pathlib.Path, default=ROOT / "build", help="where the program is")
    options.add_argument("--repeat", type=int, default=9, help="rounds of which the median is taken")
    options.add_argument("--quick", action="store_true", help="no shares of folders")
    given, _ = options.parse_known_args()
    program, results = str(given.build / "gudgeon"), given.build / "bench"
    rows = []
    with tempfile.TemporaryDirectory(prefix="gudgeon_bench_") as temporary:
        directory = pathlib.Path(temporary)
        tiny = [("output", "every", "24 ms"), ("output", "channels", "slider.position"), ("output", "contact_rows", "off")]
        decks = {"small run": written(directory, plain_deck(tiny), "tiny.deck"),
                 "small run, with the output of the deck": written(directory, plain_deck(), "small.deck")}
        commands = {"gudgeon version": [program, "version"], **{name: [program, "run", str(deck), "--quiet", "--out", str(directory / "out")]
                                                                for name, deck in decks.items()}}
        used = {name: [] for name in commands}
        for _ in range(given.repeat):
            for name, command in commands.items():
                used[name].append(cost(command))
        for name, costs in used.items():
            rows.append({"process": name, "cpu_ms": 1e3*statistics.median(c for c, _ in costs), "least_ms": 1e3*min(c for c, _ in costs),
                         "memory_mb": max(m for _, m in costs)})
        folders = None if given.quick else shares(list(commands.values())[-1], directory)
    print("\nA small run from start to exit: the dry slider-crank of two turns, figures off.\n")
    show(COLUMNS, rows)
    keep(COLUMNS, rows, results / "small_run.csv")
    print(LIMITS)
    if folders:
        print("\nShare of the instructions of that run, by folder of src/ and by library:\n")
        show(("folder", "percent", "millions"), folders)
        keep(("folder", "percent", "millions"), folders, results / "folders.csv")


if __name__ == "__main__":
    main()
