"""What a sample costs beside an evaluation of the right-hand side, in instructions (callgrind).

The dry slider-crank of two turns with twelve channels, figures off, output instants closer than steps. A sample is what the run does
for an output instant: the state there, an evaluation, reactions, the channels; the row is what is written for it to run.h5. A second table
has the instructions of one run of the study of the clearance, `gudgeon run inputs/studies/clearance_study.deck --member 3 --write numbers`.
"""

import argparse
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tests" / "e2e"))
from pictures import keep, show  # noqa: E402
from support import plain_deck, written  # noqa: E402

CHANNELS = ("slider.position slider.velocity slider.acceleration rod.angle rod.angular_velocity motor.moment motor.coordinate "
            "main.force gudgeon.eccentricity gudgeon.force gudgeon.penetration gudgeon.normal_force")
PARTS = {"evaluation": "__mechanism_MOD_mechanism_evaluate", "sample": "__sampling_MOD_report", "row": "__run_recorder_MOD_sample_run"}
LIMITS = "Bounds: a sample at most 3.0 evaluations; the run of the study at most 1050 millions of instructions."


def profile(command, directory):
    """Instructions of a run, and calls and instructions of each of its parts."""
    out = directory / "callgrind.out"
    done = subprocess.run(["valgrind", "--tool=callgrind", f"--callgrind-out-file={out}", *command], capture_output=True, text=True)
    total = re.search(r"Collected : (\d+)", done.stderr)
    if done.returncode != 0 or not total:
        sys.exit(f"{' '.join(command)} ended with status {done.returncode}")
    told = subprocess.run(["callgrind_annotate", "--inclusive=yes", "--tree=caller", "--auto=no", "--threshold=100", str(out)],
                          capture_output=True, text=True, check=True).stdout
    parts = {name: [0, 0] for name in PARTS}
    callers = []
    for line in told.splitlines():
        found = re.match(r"\s*([\d,]+) \([\s\d.]+%\)\s+([<*])\s+\S*?:(\w+)\S*(?: \(([\d,]+)x\))?", line)
        if not found:
            callers = []
            continue
        number = int(found[1].replace(",", ""))
        if found[2] == "<":
            callers.append(int((found[4] or "0").replace(",", "")))
            continue
        for name, symbol in PARTS.items():
            if found[3] == symbol and sum(callers) > parts[name][0]:  # texts that it includes are listed as its own, without their callers
                parts[name] = [sum(callers), number]
        callers = []
    return int(total[1]), parts


def main():
    """Measure, show and keep."""
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--build", type=pathlib.Path, default=ROOT / "build", help="where the program is")
    given, _ = options.parse_known_args()
    if not shutil.which("valgrind") or not shutil.which("callgrind_annotate"):
        print("\nWhat a sample costs: valgrind is not installed.")
        return
    program, results = str(given.build / "gudgeon"), given.build / "bench"
    with tempfile.TemporaryDirectory(prefix="gudgeon_bench_") as temporary:
        directory = pathlib.Path(temporary)
        dense = [("output", "every", "2 us"), ("output", "channels", CHANNELS), ("output", "contact_rows", "off")]
        deck = written(directory, plain_deck(dense), "dense.deck")
        _, parts = profile([program, "run", str(deck), "--quiet", "--write", "channels", "--out", str(directory / "out")], directory)
        study = ROOT / "inputs" / "studies" / "clearance_study.deck"
        whole, _ = profile([program, "run", str(study), "--member", "3", "--write", "numbers", "--quiet", "--out",
                            str(directory / "study")], directory)
    one = parts["evaluation"][1]/max(parts["evaluation"][0], 1)
    rows = [{"part": name, "calls": calls, "instructions": total/max(calls, 1), "evaluations": total/max(calls, 1)/one}
            for name, (calls, total) in parts.items()]
    columns = ("part", "calls", "instructions", "evaluations")
    print("\nWhat a sample with twelve channels costs, in instructions and in evaluations.\n")
    show(columns, rows)
    keep(columns, rows, results / "sample_cost.csv")
    print(f"\nOne run of the study of the clearance: {whole/1e6:.0f} millions of instructions.")
    print(LIMITS)


if __name__ == "__main__":
    main()
