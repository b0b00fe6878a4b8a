"""What a mechanism of the plane costs in space: instructions of a right-hand side (callgrind) and its time.

The dry slider-crank, 6 ms, as the deck of the plane has it (its crank a known function of time), with all coordinates of the plane, and
translated to space (a pin in a bushing with half of the stiffness at each base). Onsets: of the first five impacts against those of the plane.
"""

import argparse
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tests" / "e2e"))
from pictures import keep, show  # noqa: E402
from sample_cost import profile  # noqa: E402
from support import Run, plain_deck, written  # noqa: E402
from translated import in_space  # noqa: E402

COLUMNS = ("model", "rhs", "instructions_per_rhs", "times_the_plane", "ns_per_rhs", "onsets_off_s")
LIMIT = "Bound: in space at most 4 times the instructions of the plane."


def main():
    """Measure, show and keep."""
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--build", type=pathlib.Path, default=ROOT / "build", help="where the program is")
    options.add_argument("--repeat", type=int, default=5, help="runs of which the fastest is taken")
    given, _ = options.parse_known_args()
    program, results = str(given.build / "gudgeon"), given.build / "bench"
    changes = [("analysis.dynamic", "end", "6 ms"), ("analysis.dynamic", "tolerance", "1e-11"), ("analysis.dynamic", "ledger", "off"),
               ("output", "every", "6 ms"), ("output", "channels", "slider.position"), ("output", "contact_rows", "off")]
    planar = plain_deck(changes)
    texts = {"plane": planar, "plane, all coordinates": plain_deck([*changes, ("analysis.dynamic", "coordinates", "full")]),
             "space": in_space(planar)}
    rows, onsets = [], None
    with tempfile.TemporaryDirectory(prefix="gudgeon_bench_") as temporary:
        directory = pathlib.Path(temporary)
        for name, text in texts.items():
            out = directory / "out"
            command = [program, "run", str(written(directory, text)), "--quiet", "--out", str(out)]
            times = []
            for _ in range(given.repeat):
                subprocess.run(command, check=True)
                summary = json.loads((out / "summary.json").read_text())
                times.append(1e9*summary["cpu_seconds"]/summary["rhs_evaluations"])
            found = Run(out).contacts["time"][:: 2 if name == "space" else 1][:5]
            onsets = found if onsets is None else onsets
            row = {"model": name, "rhs": summary["rhs_evaluations"], "ns_per_rhs": min(times), "onsets_off_s": float(max(abs(found - onsets))),
                   "instructions_per_rhs": "-", "times_the_plane": "-"}
            if shutil.which("valgrind") and shutil.which("callgrind_annotate"):
                calls, instructions = profile(command, directory)[1]["evaluation"]
                row["instructions_per_rhs"] = instructions/calls
                row["times_the_plane"] = row["instructions_per_rhs"]/(rows[0] if rows else row)["instructions_per_rhs"]
            rows.append(row)
    print("\nThe dry slider-crank in the plane and translated to space.\n")
    show(COLUMNS, rows)
    keep(COLUMNS, rows, results / "space_cost.csv")
    print(LIMIT)


if __name__ == "__main__":
    main()
