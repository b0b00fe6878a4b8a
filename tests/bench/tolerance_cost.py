"""What a study of tolerances costs beside the motions of its members, in processor time of one process after the other.

Dynamic level: the dry slider-crank of inputs/studies/tolerance_study.deck without its ensemble, indices by a polynomial, 16 and 2 turns.
`motions_s`: of the motions of all runs and what is read off them, as sweep.h5 has it; `study_s`: of the whole study with all its
processes. `solution_s`: as many runs as the study has, each with the median `cpu_seconds` of single runs of the nominal deck: motions
without output times. Kinematic level: the four-bar of inputs/tolerance_four_bar.deck, members by the expansion and assembled.
"""

import argparse
import json
import math
import pathlib
import re
import resource
import statistics
import subprocess
import sys
import tempfile

import h5py

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tests" / "e2e"))
from pictures import keep, show  # noqa: E402

COLUMNS = ("study", "members", "study_s", "motions_s", "ratio", "solution_s", "us_per_member")
SINGLE_RUNS = 15
LIMITS = "Bounds: a dynamic study of 16 turns at most 1.1 times its motions; 1e6 members of the four-bar 10 s."


def dynamic(turns, members):
    """The deck of a study of so many runs of so many turns."""
    text = (ROOT / "inputs" / "studies" / "tolerance_study.deck").read_text(encoding="utf-8")
    text = re.sub(r"\[ensemble\]\n(?:.+\n)*", "", text)
    for old, new in (("members  = 40", f"members = {members}\nindices = polynomial"), ("end       = 16 turns", f"end = {turns} turns"),
                     ("after    = 6 turns", f"after = {turns*0.375} turns")):
        assert old in text, old
        text = text.replace(old, new)
    return text


def kinematic(method, members):
    """The deck of a study of so many members of the four-bar."""
    text = (ROOT / "inputs" / "tolerance_four_bar.deck").read_text(encoding="utf-8")
    return f"{text}\n[tolerance.study]\nmembers = {members}\nmethod = {method}\npoints = 10\nchecked = 10\n"


def measured(program, directory, name, text, members):
    """A row: one study."""
    deck, out = directory / "study.deck", directory / name.replace(" ", "_").replace(",", "")
    deck.write_text(text, encoding="utf-8")
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([program, "tolerance", str(deck), "--jobs", "1", "--quiet", "--out", str(out)], check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime
    row = {"study": name, "members": members, "study_s": cpu, **dict.fromkeys(("motions_s", "ratio", "solution_s"), math.nan)}
    if (out / "sweep.h5").exists():
        with h5py.File(out / "sweep.h5") as file:
            motions = file["provenance/cpu_run"][()]
        single = [program, "run", str(deck), "--write", "numbers", "--quiet", "--json", "--out", str(out) + "_single"]
        seconds = [json.loads(subprocess.run(single, capture_output=True, text=True, check=True).stdout)["cpu_seconds"]
                   for _ in range(SINGLE_RUNS)]
        row.update(motions_s=float(motions.sum()), ratio=cpu/float(motions.sum()), solution_s=len(motions)*statistics.median(seconds))
    own = json.loads((out / "summary.json").read_text(encoding="utf-8"))["tolerance_study"]["cpu_members"]
    row["us_per_member"] = 1e6*own/members
    return row


def main():
    """Measure, show and keep."""
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--build", type=pathlib.Path, default=ROOT / "build", help="where the program is")
    options.add_argument("--quick", action="store_true", help="a tenth of the members")
    given, _ = options.parse_known_args()
    part = 10 if given.quick else 1
    with tempfile.TemporaryDirectory(prefix="gudgeon_bench_") as temporary:
        rows = [measured(str(given.build / "gudgeon"), pathlib.Path(temporary), name, text(kind, n//part), n//part)
                for name, text, kind, n in (("runs of 16 turns", dynamic, 16, 1000), ("runs of 2 turns", dynamic, 2, 1000),
                                            ("four-bar, expansion", kinematic, "expansion", 1000000),
                                            ("four-bar, assembled", kinematic, "exact", 10000))]
    print("\nWhat a study of tolerances costs beside the motions of its members.\n")
    show(COLUMNS, rows)
    keep(COLUMNS, rows, given.build / "bench" / "tolerance_cost.csv")
    print(LIMITS)


if __name__ == "__main__":
    main()
