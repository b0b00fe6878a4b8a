"""Running one way of one hard case: error, energy drift, constraint violation, cost and verdict."""

import dataclasses
import math
import pathlib
import re
import subprocess

import numpy as np
from support import Run, written

LIMIT = 60  # seconds for one run
NOT_COUNTED = ("stabilisation_work", "residual")  # what holding the constraints adds is drift


@dataclasses.dataclass
class Result:
    """A line of the table."""

    case: str
    method: str
    tolerance: str
    what: str
    error: float = math.nan
    limit: float = math.nan
    energy_drift: float = math.nan
    violation: float = math.nan
    violation_limit: float = math.nan
    cpu_seconds: float = math.nan
    steps: int = 0
    verdict: str = ""

    @property
    def has_failed(self):
        """Whether it falls short of a stated limit."""
        return self.verdict.startswith("FAILED")


def energy_drift(run):
    """Greatest departure of the energy from what was given and lost, by the largest energy."""
    balance = 0.0
    for name, values in run.group("energy").items():
        if name not in NOT_COUNTED:
            taken = name.endswith("_work")
            balance = balance + (-values if taken else values)
    largest = run.summary["energy_max"]
    return float(np.max(np.abs(balance - balance[0])))/largest if largest > 0 else 0.0


def verdict(case, way, result, output):
    """`ok`, `shown`, or what falls short."""
    if not way.is_required:
        return "shown"
    if way.limit is not None and not result.error <= way.limit:
        return "FAILED: error"
    if way.violation is not None and not result.violation <= way.violation:
        return "FAILED: violation"
    missing = [text for text in case.says if not re.search(text, output)]
    return f"FAILED: does not say {missing[0]}" if missing else "ok"


def solve(program, case, way, directory):
    """Run one way of a case in a directory of its own."""
    result = Result(case.name, way.label, way.step or way.tolerance, case.what)
    result.limit = math.nan if way.limit is None else way.limit
    result.violation_limit = math.nan if way.violation is None else way.violation
    directory = pathlib.Path(directory)
    deck = written(directory, case.text(way), pathlib.Path(case.deck).name)
    command = [str(program), "run", str(deck), "--out", str(directory / "out")]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=LIMIT, stdin=subprocess.DEVNULL)
    except subprocess.TimeoutExpired:
        result.verdict = f"{'FAILED: ' if way.is_required else ''}no end after {LIMIT} s"
        return result
    output = done.stdout + done.stderr
    expected = (4, 5) if case.ends_early else (0,)
    if done.returncode not in expected:
        message = next((line for line in output.splitlines() if line.startswith("error")), "")[:60]
        result.verdict = f"{'FAILED: ' if way.is_required else 'ended: '}code {done.returncode} {message}".strip()
        return result
    measure_run(case, result, Run(directory / "out"), output)
    result.verdict = verdict(case, way, result, output)
    return result


def measure_run(case, result, run, output):
    """The numbers of a run that ended as it should."""
    if case.ends_early:
        result.error = case.measure(output)
        if not (run.directory / "summary.json").exists():  # it did not even begin
            return
    summary = run.summary
    result.cpu_seconds, result.steps = summary["cpu_seconds"], summary["steps"]
    if case.ends_early:
        return
    result.error = case.measure(run)
    result.violation = summary["violation_max"]
    result.energy_drift = energy_drift(run)
