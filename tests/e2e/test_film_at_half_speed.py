"""A load at half the speed of the shaft: its film has no wedge, so that the velocity that squeezes it is the small difference of large ones."""

import re

import numpy as np
from support import ROOT, Run, call, changed, scratch, written


def run(program, method, tolerance):
    """The bearing of tutorial 3: 1 kN turning with 1500 rpm, the shaft with 3000 rpm."""
    page = (ROOT / "docs" / "tutorials" / "3-journal-bearing.md").read_text(encoding="utf-8")
    text = changed(re.search(r"```deck bearing.deck\n(.*?)```", page, re.DOTALL)[1], "output", every="1 ms", figures=None,
                   channels="journal.position bearing.film_thickness")
    directory = scratch()
    call(program, "run", written(directory, text), "--set", "turn=1500 rpm", "--set", "weight=0 N", "--set", "skip=0", "--method", method,
         "--tolerance", tolerance, "--out", directory / "out", "--write", "channels", "--quiet")
    return Run(directory / "out")


def evaluations(one):
    """Right-hand sides of the motion."""
    return one.summary["rhs_evaluations"] - one.summary["output_evaluations"]


def test_jacobian_of_a_film_that_carries_next_to_nothing(gudgeon):
    """Differences for the Jacobian are short beside that velocity, however far the shaft has turned: few evaluations, and the motion of bdf."""
    exact = run(gudgeon, "bdf", "1e-11")
    thickness = exact.read("clearances/film_thickness").ravel()
    assert thickness[-1] < 0.05*thickness[0]
    most = 4*evaluations(run(gudgeon, "bdf", "1e-8"))
    for method in ("radau", "auto"):
        found = run(gudgeon, method, "1e-8")
        assert evaluations(found) < most, method
        np.testing.assert_allclose(found.read("bodies/position"), exact.read("bodies/position"), atol=1e-3*thickness[0])
