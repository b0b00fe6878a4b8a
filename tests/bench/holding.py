"""CPU time against error of each way of holding the constraints, and of each integrator, on the four-bar and on A02; of each
integrator on Bricard's mechanism (A04), the flyball governor (A05) and a slider-crank in space.

Errors are those of `make stability`: the angles of the four-bar at 0.1 to 5 s against an independent solution, the place of the
first joint of the ten four-bars of A02 after 10 s against the exact motion; energy of Bricard's mechanism, slider of governor and
slider-crank against independent integrations. CPU times are those of the solution alone. A way that ends early, or not within a
minute, stands in the table without an error.
"""

import argparse
import dataclasses
import math
import pathlib
import statistics
import sys
import tempfile

from pictures import draw, keep, show

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tests" / "stability"))
from cases import CASES, HOLDS, METHODS, Way  # noqa: E402
from runs import solve  # noqa: E402

TOLERANCES = tuple(f"1e-{k}" for k in range(5, 11))
STEPS = {"four-bar": ("0.4 ms", "0.2 ms", "0.1 ms", "0.05 ms", "0.025 ms"), "A02 N = 10": ("8 ms", "4 ms", "2 ms", "1 ms", "0.5 ms")}
SPATIAL = {"A04 Bricard": METHODS, "A05 governor": ("radau", "bdf", "ida"), "spatial slider-crank": METHODS}  # multistep methods of each
SCENES = (*STEPS, *SPATIAL)
COLUMNS = ("scene", "method", "tolerance", "error", "violation", "energy_drift", "cpu_ms", "steps", "verdict")


def ways(scene, quick):
    """Each way of holding with Verner's method, each integrator and RK4 with the default way."""
    tolerances = TOLERANCES[1::2] if quick else TOLERANCES
    if scene in SPATIAL:
        for method in ("verner", "dop853", *SPATIAL[scene]):
            yield from (Way(tolerance, method=method) for tolerance in tolerances)
        return
    for hold in HOLDS:
        yield from (Way(tolerance, stabilise=hold) for tolerance in tolerances)
    for method in METHODS:
        yield from (Way(tolerance, method=method) for tolerance in tolerances)
    yield from (Way("", method="rk4", step=step) for step in STEPS[scene][:: 2 if quick else 1])


def measured(program, case, way, repeat):
    """One row of the table."""
    results = []
    for _ in range(repeat):
        with tempfile.TemporaryDirectory(prefix="gudgeon_bench_") as temporary:
            results.append(solve(program, case, way, temporary))
        if math.isnan(results[-1].cpu_seconds):
            break
    row = dataclasses.asdict(results[-1])
    row["scene"], row["cpu_ms"] = case.name, 1e3*statistics.median(result.cpu_seconds for result in results)
    row["method"] = row["method"].removesuffix(" auto")
    row["verdict"] = "" if row["verdict"] == "shown" else row["verdict"].split(" error")[0]
    return row


def main():
    """Measure all, show, keep, draw."""
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--build", type=pathlib.Path, default=ROOT / "build", help="where the program is")
    options.add_argument("--repeat", type=int, default=3, help="runs of which the median is taken, at most 3")
    options.add_argument("--quick", action="store_true", help="every second tolerance")
    given, _ = options.parse_known_args()
    program, results = (given.build / "gudgeon").resolve(), given.build / "bench"
    rows = []
    for name in SCENES:
        case = next(case for case in CASES if case.name == name)
        rows += [measured(program, case, way, min(given.repeat, 3)) for way in ways(name, given.quick)]
    print("\nWays of holding the constraints, and integrators: CPU time against error.\n")
    show(COLUMNS, rows)
    keep(COLUMNS, rows, results / "holding.csv")
    for name in SCENES:
        series = {}
        for row in rows:
            if row["scene"] == name and row["error"] > 0.0:
                series.setdefault(row["method"], []).append((row["error"], row["cpu_ms"]))
        picture = results / f"holding_{name.lower().replace(' = ', '').replace(' ', '_')}.png"
        what = next(case for case in CASES if case.name == name).what
        draw(series, picture, f"{name}: tolerances {TOLERANCES[0]} to {TOLERANCES[-1]}", (f"error, {what}", "CPU time [ms]"))
    print(f"\n{results}/holding.csv holds this table, holding_*.png its pictures.")


if __name__ == "__main__":
    main()
