"""The gondola that a bar keeps upright: joint.parallel against closed forms, by every way of holding the constraints."""

import numpy as np
import pytest
from support import ROOT, Run, assert_close, call, changed, scratch, written

MASS, LENGTH, DROP, INERTIA, G = 120.0, 4.0, 0.6, 40.0, 9.81


def run_wheel(program, **settings):
    """Run the deck with other settings of the analysis."""
    directory = scratch()
    text = changed((ROOT / "inputs/ferris_wheel.deck").read_text(), "output", figures=None)
    call(program, "run", written(directory, changed(text, "analysis.dynamic", **settings)), "--out", directory / "out", "--quiet")
    return Run(directory / "out")


@pytest.mark.parametrize("settings", [{}, {"stabilise": "partitioning"}, {"stabilise": "baumgarte alpha=5s^-1 beta=5s^-1"},
                                      {"coordinates": "full"}, {"method": "ida"}, {"solver": "sparse"}], ids=str)
def test_gondola_stays_upright(gudgeon, settings):
    """It does not turn; the arm is a pendulum with (I + m L^2) angle'' = -m g L cos(angle); the bar takes what would turn the gondola."""
    run = run_wheel(gudgeon, **settings)
    close = 1e-6
    angle, rate = run.item("bodies/angle", "arm"), run.item("bodies/angular_velocity", "arm")
    assert_close(run.item("bodies/angle", "gondola"), 0 * angle, absolute=close, what="gondola")
    inertia = INERTIA + MASS * LENGTH**2  # the arm's own mass is at the hub
    energy = 0.5 * inertia * rate**2 + MASS * G * LENGTH * np.sin(angle)
    assert_close(energy, energy[0] + 0 * energy, absolute=close * energy[0], what="energy")
    assert angle.max() > 6 * np.pi
    acceleration = -MASS * G * LENGTH * np.cos(angle) / inertia
    pull = MASS * LENGTH * (-np.sin(angle) * acceleration - np.cos(angle) * rate**2)  # of the pin on the gondola, to the right
    moment = run.item("joints/moment", "bar")
    assert_close(moment, DROP * pull, absolute=1e-4 * abs(moment).max(), what="moment on the gondola")
    assert abs(moment).max() > 1000
