"""Multipliers that IDA integrates with: the ledger, which is made of their powers, closes as the tolerance says, and rows tell them."""

import numpy as np
import pytest
from support import ROOT, Run, call, scratch


@pytest.mark.parametrize("deck, tolerance, limit", [("bent_shafts", "1e-4", 2e-4), ("bent_shafts", "1e-7", 1e-6), ("quick_return", "1e-4", 2e-3),
                                                    ("quick_return", "1e-7", 5e-6), ("slider_crank_6_6_ball", "1e-7", 1e-7)])
def test_ledger_closes(gudgeon, deck, tolerance, limit):
    """Where forces do not move the mechanism, as in driven ones, nothing else tells that Newton's iteration has not found them: the energy
    of such runs was off by up to 94 % of the largest one."""
    directory = scratch()
    call(gudgeon, "run", ROOT / f"inputs/{deck}.deck", "--method", "ida", "--tolerance", tolerance, "--out", directory / "out", "--quiet",
         "--write", "numbers")
    summary = Run(directory / "out").summary
    assert summary["status"] == "complete"
    assert summary["energy_residual_max"] < limit * summary["energy_max"]


def test_moment_of_a_motor(gudgeon):
    """Rows have the moment of a motor that turns two shafts evenly faster and slower, from its definition."""
    directory = scratch()
    call(gudgeon, "run", ROOT / "inputs/bent_shafts.deck", "--method", "ida", "--tolerance", "1e-5", "--out", directory / "out", "--quiet",
         "--write", "channels")
    run = Run(directory / "out")
    assert np.abs(run.item("drivers/moment", "motor").ravel() - (0.007 * 200 * np.sin(10 * run.time) + 0.2)).max() < 2e-4
