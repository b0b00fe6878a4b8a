"""Rows within long steps of what decays fast: against a closed form, and of a film against a tight run of another method."""

import numpy as np
import pytest
from support import ROOT, Run, assert_close, call, changed, run_with, scratch, written

OVERDAMPED = """deck = 1
[scene]
gravity = 0 0 m/s^2
[bodies]
name   mass[kg]  inertia[kg.m^2]  x[m]  y[m]  angle[deg]  vx[m/s]
block  1         1                1     0     0           -1
[points]
name  body    xi[m]  eta[m]
o     ground  0      0
c     block   0      0
g     ground  5      0
[joint.translational]
name   i  j  axis
slide  o  c  x
[force.spring]
name  i  j  stiffness[N/m]  free_length[m]  damping[N.s/m]
s     g  c  1e6             5               1e6
[analysis.dynamic]
start = given
end = 5 s
[output]
every = 10 ms
channels = block.position block.velocity
"""


@pytest.mark.parametrize("method", ["rock4", "radau", "bdf", "ida"])
def test_overdamped(gudgeon, method):
    """x'' + 1e6 (x' + x) = 0 from (1, -1) is exp(-t) but for the millionth part of it; most rows are far from the ends of steps."""
    directory = scratch()
    call(gudgeon, "run", written(directory, OVERDAMPED), "--method", method, "--tolerance", "1e-6", "--out", directory / "out", "--quiet")
    run = Run(directory / "out")
    time = run.read("time")
    np.testing.assert_allclose(run.item("bodies/position", "block")[:, 0], np.exp(-time), atol=2e-5)
    np.testing.assert_allclose(run.item("bodies/velocity", "block")[:, 0], -np.exp(-time), atol=2e-5)


def test_film_between_steps(gudgeon):
    """The film of the journal bearing at output instants, three to a step: at 1e-6 within a twentieth of its greatest force."""
    text = (ROOT / "inputs" / "journal_bearing.deck").read_text(encoding="utf-8")
    found, exact = (run_with(gudgeon, text, method=method, tolerance=tolerance).read("clearances/film_force")
                    for method, tolerance in (("rock4", "1e-6"), ("radau", "1e-8")))
    greatest = np.max(np.linalg.norm(exact[:, 0, :], axis=-1))
    np.testing.assert_allclose(found, exact, atol=0.05 * greatest)


@pytest.mark.parametrize("deck, end, every", [("slider_crank_lubricated", "10 ms", "10 us"), ("hard/stressed_bearing", "0.2 s", "1 ms")])
def test_steps_do_not_depend_on_rows(gudgeon, deck, end, every):
    """Ten times as many rows: the same steps, to the bit at the end of the motion; between, film forces differ by what rows may be wrong by."""
    text = changed((ROOT / "inputs" / f"{deck}.deck").read_text(), "analysis.dynamic", end=end, method="radau")
    fine, coarse = (run_with(gudgeon, changed(text, "output", every=words, figures=None)) for words in (every, every.replace(" ", "0 ")))
    assert fine.summary["steps"] == coarse.summary["steps"]
    assert np.array_equal(fine.read("bodies/position")[-1], coarse.read("bodies/position")[-1])
    ours, theirs = (run.read("clearances/film_force")[run.read("row_kind") == 0] for run in (fine, coarse))
    assert_close(ours[::10], theirs, absolute=2e-4 * np.abs(theirs).max(), what="film force")
