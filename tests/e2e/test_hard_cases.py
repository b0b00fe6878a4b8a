"""The hard cases of inputs/hard: the fast ones of the table of `make stability`, and the generator of chains."""

import shutil
import subprocess
import sys

import numpy as np
import pytest
from support import ROOT, Run, call, changed, made, scratch, written

sys.path.insert(0, str(ROOT / "tests" / "stability"))
from cases import CASES, SOLVERS  # noqa: E402
from runs import solve  # noqa: E402

FAST = [pytest.param(case, way, id=f"{case.name}, {way.tolerance}") for case in CASES for way in case.ways if way.is_fast]
DYNAMIC = [deck for folder in ("inputs", "inputs/hard") for deck in sorted((ROOT / folder).glob("*.deck"))
           if "[analysis.dynamic]" in deck.read_text()]
GENERATED = (("four_bars", 1), ("four_bars", 2), ("four_bars", 10), ("four_bars", 40))


@pytest.mark.parametrize("case, way", FAST)
def test_hard_case_keeps_its_limit(gudgeon, case, way):
    """The default way of solving it, against the reference that the table names."""
    result = solve(gudgeon, case, way, scratch())
    assert result.verdict == "ok", f"{result.verdict}: error {result.error:.3g}, limit {result.limit:.3g} ({case.what})"


def start_accelerations(gudgeon, deck, solver):
    """Accelerations of all bodies at the start and a microsecond later, translations and rotations in one array."""
    directory = scratch()
    for beside in deck.parent.glob("*.txt"):  # tables that decks name
        shutil.copy(beside, directory)
    text = changed(deck.read_text(), "analysis.dynamic", solver=solver, start="ideal", end="1 us", method="rk4", step="1 us")
    text = changed(text, "output", every="1 us", channels="*.acceleration *.angular_acceleration", figures=None)
    call(gudgeon, "run", written(directory, text), "--out", directory / "out", "--quiet")
    bodies = Run(directory / "out").group("bodies")
    turning = bodies["angular_acceleration"]
    return np.concatenate([bodies["acceleration"], turning.reshape(*turning.shape[:2], -1)], axis=-1)


@pytest.mark.parametrize("deck", DYNAMIC, ids=[deck.stem for deck in DYNAMIC])
def test_solvers_agree_on_accelerations(gudgeon, deck):
    """Every way of solving the augmented equations gives the accelerations of complete pivoting, to 1e-10 of the greatest."""
    expected = start_accelerations(gudgeon, deck, "complete")
    greatest = np.max(np.abs(expected))
    for solver in SOLVERS:
        error = np.max(np.abs(start_accelerations(gudgeon, deck, solver) - expected))
        assert error <= 1e-10*greatest, f"{solver}: accelerations differ by {error/greatest:.2g} of the greatest"


@pytest.mark.parametrize("kind, n", GENERATED)
def test_decks_are_what_the_generator_writes(kind, n):
    """The decks of A02 can be made again."""
    assert (ROOT / "inputs" / "hard" / f"a02_{kind}_{n}.deck").read_text() == made(kind, n)


@pytest.mark.parametrize("n", (1, 3, 100))
def test_chain_keeps_its_energy(gudgeon, n):
    """A chain released at rest: no energy comes or goes, and its pins hold."""
    directory = scratch()
    deck = written(directory, changed(made("pendulum", n, "--end", "0.5"), "analysis.dynamic", tolerance="1e-10"))
    call(gudgeon, "run", deck, "--out", directory / "out", "--quiet")
    summary = Run(directory / "out").summary
    assert summary["energy_residual_max"] <= 1e-8*summary["energy_max"]
    assert summary["violation_max"] <= 1e-9


def test_generator_refuses_nonsense():
    """No deck without a kind and a number."""
    for arguments in ([], ["pendulum"], ["pendulum", "0"], ["bridge", "3"]):
        done = subprocess.run(
            [sys.executable, "-B", ROOT / "scripts" / "make_chain", *arguments], capture_output=True, text=True
        )
        assert done.returncode == 2
        assert "make_chain" in done.stderr and done.stdout == ""


@pytest.mark.parametrize("deck, law", (("pin_at_rest", "flores"), ("dropped_ball", "exact"), ("dropped_ball", "flores")))
def test_steps_of_a_contact_at_rest_do_not_collapse(gudgeon, deck, law):
    """A pin and a ball that came to rest: a late second takes no more steps than the one in which the bounces died out."""
    steps = []
    for end in (1, 2, 10):
        directory = scratch()
        text = changed((ROOT / "inputs" / "hard" / f"{deck}.deck").read_text(), "analysis.dynamic", end=f"{end} s")
        text = changed(changed(text, "parameters", law=law), "output", figures=None)
        call(gudgeon, "run", written(directory, text), "--out", directory / "out", "--quiet")
        steps.append(Run(directory / "out").summary["steps"])
    early, late = steps[0], (steps[2] - steps[1])/8
    assert late <= 1.2*early, f"{late} steps per second late, {early} in the first"
