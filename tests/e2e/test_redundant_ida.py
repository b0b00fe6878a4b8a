"""Method ida where rows depend on one another: the motion of the other methods, or a message that says why not."""

import re

import numpy as np
import pytest
from support import ROOT, Run, call, changed, scratch, written

HARD = ROOT / "inputs/hard"


def run(program, text, *options, expect=0):
    """A run without figures."""
    directory = scratch()
    text = changed(text, "output", figures=None, motion=None)
    done = call(program, "run", written(directory, text), "--out", directory / "out", "--quiet", *options, expect=expect)
    return Run(directory / "out", done)


@pytest.mark.parametrize("name, end", [("duplicated_joints", "1 s"), ("door_on_three_hinges", "1 s"), ("a04_bricard", "0.5 s"),
                                       ("overdetermined_four_bar", "0.6 s"), ("three_pins", "0.8 s")])
def test_motion_is_that_of_other_methods(gudgeon, name, end):
    """Rows that depend on others are left out, and others where those that were kept come to depend on one another."""
    text = changed((HARD / f"{name}.deck").read_text(), "analysis.dynamic", end=end, tolerance="1e-8")
    text = re.sub(r"(?m)^(channels\s*=).*$", r"\1 *", text)
    one, other = (run(gudgeon, text, "--method", method) for method in ("ida", "verner"))
    size = max(abs(other.read("bodies/position")).max(), 1e-3)
    assert abs(one.read("bodies/position") - other.read("bodies/position")).max() < 2e-6 * size
    assert abs(one.read("bodies/velocity") - other.read("bodies/velocity")).max() < 2e-5 * abs(other.read("bodies/velocity")).max()
    force, expected = one.read("joints/force"), other.read("joints/force")
    middle = len(force) // 2
    assert abs(force[middle] - expected[middle]).max() < 1e-4 * np.abs(expected).max()  # of least norm, from the same solver
