"""The dry slider-crank by every method: first impacts against the independent solution, to the accuracy of docs/theory/evidence/accuracy.md."""

import sys

import numpy as np
import pytest
from reference_values import IMPACT_FIELDS, IMPACTS
from support import ROOT, Run, assert_close, call, finished, scratch, written

sys.path.insert(0, str(ROOT / "tests" / "stability"))
from random_scenes import draw  # noqa: E402

REFERENCE = {field: np.array(column) for field, column in zip(IMPACT_FIELDS, zip(*IMPACTS))}
SHORT = ("analysis.dynamic", "end", "3.4 ms")  # ten impacts

# method, tolerance: errors allowed of the first ten onsets [s], of impact speeds and peak forces of the first five impacts
ALLOWED = {
    ("adams", "1e-8"): (5e-8, 2e-4),
    ("adams", "1e-10"): (1e-9, 1e-6),
    ("bdf", "1e-8"): (1e-7, 5e-4),
    ("bdf", "1e-10"): (5e-9, 2e-5),
    ("radau", "1e-8"): (1e-9, 5e-6),
    ("radau", "1e-10"): (1e-10, 5e-7),
    ("rock4", "1e-8"): (1e-8, 5e-5),
    ("rock4", "1e-10"): (2e-10, 1e-6),
    ("ida", "1e-8"): (5e-8, 5e-5),
    ("ida", "1e-10"): (5e-10, 2e-6),
}


def check_impacts(run, onsets, relative):
    """First ten onsets, and what is known of the first five impacts."""
    assert run.summary["status"] == "complete"
    assert_close(run.contacts["time"][:10], REFERENCE["time"], absolute=onsets, what="onsets")
    for field in ("impact_speed", "peak_force"):
        assert_close(run.contacts[field][:5], REFERENCE[field][:5], relative=relative, what=field)
    for field in ("release_speed", "energy_lost"):
        assert_close(run.contacts[field][:5], REFERENCE[field][:5], relative=10 * relative, what=field)


@pytest.mark.parametrize("method, tolerance", ALLOWED)
def test_impacts(gudgeon, method, tolerance):
    """The summary names the method; impacts are as accurate as stated, and the ledger closes."""
    run = finished(gudgeon, "--method", method, "--tolerance", tolerance, changes=(SHORT,))
    assert run.summary["method"] == method
    check_impacts(run, *ALLOWED[method, tolerance])
    assert run.summary["energy_residual_max"] < 20 * float(tolerance) ** 0.9 * run.summary["energy_max"]


@pytest.mark.parametrize("method, tolerance", [("adams", "1e-4"), ("bdf", "1e-4"), ("ida", "1e-5"), ("ida", "1e-6")])
def test_loose_tolerances(gudgeon, method, tolerance):
    """The first step in contact may be wrong by more than the penetration by then; that ends no contact."""
    run = finished(gudgeon, "--method", method, "--tolerance", tolerance, changes=(SHORT,))
    assert_close(run.contacts["time"][0], REFERENCE["time"][0], absolute=1e-6, what="first onset")
    assert_close(run.contacts["impact_speed"][:2], REFERENCE["impact_speed"][:2], relative=0.05, what="impact speeds")
    assert len(run.contacts["time"]) <= 14


@pytest.mark.parametrize("method", ["adams", "bdf"])
@pytest.mark.parametrize("tolerance", ["1e-3", "1e-4"])
def test_free_surfaces_do_not_overlap(gudgeon, method, tolerance):
    """A contact that parts slowly does not go on, free, inside the other surface: a step that says so is repeated, shorter."""
    changes = (("output", "every", "2 us"), ("output", "channels", "gudgeon.*"))
    run = finished(gudgeon, "--method", method, "--tolerance", tolerance, changes=changes)
    free = run.rows("clearances/contacts/state")[:, 0] == 0
    assert free.sum() > 1000
    assert run.rows("clearances/contacts/penetration")[free, 0].max() < 1e-9
    assert run.summary["energy_residual_max"] < 0.01 * run.summary["energy_max"]


def test_force_that_jumps_at_an_onset_by_rock4(gudgeon):
    """The first step of a contact begins with the force of the dashpot. The reference: Verner's method at a tolerance of 1e-11."""
    peaks = []
    for method, tolerance in (("rock4", "1e-7"), ("verner", "1e-11")):
        directory = scratch()
        call(gudgeon, "run", ROOT / "inputs" / "hard" / "wedged_slider.deck", "--method", method, "--tolerance", tolerance, "--write", "numbers",
             "--out", directory / "out", "--quiet")
        peaks.append(Run(directory / "out").contacts["peak_force"])
    assert len(peaks[0]) == 2
    assert_close(peaks[0], peaks[1], relative=2e-6, what="peak forces")


def test_end_of_a_contact_early_in_a_step_of_rock4(gudgeon):
    """A ball in a corner: one contact ends while the other goes on, and the step before the first of them began is far longer."""
    directory = scratch()
    call(gudgeon, "run", written(directory, draw("corner", 1013).text), "--method", "rock4", "--tolerance", "1e-7", "--write", "numbers",
         "--out", directory / "out", "--quiet")
    run = Run(directory / "out")
    assert len(run.contacts) == 17
    assert run.summary["energy_residual_max"] < 1e-5 * run.summary["energy_max"]


def test_ida_begins_after_every_event(gudgeon):
    """The state of an event is on the constraints to much less than the error allowed, so that a short step from it passes."""
    run = finished(gudgeon, "--method", "ida", "--tolerance", "1e-10", changes=(("analysis.dynamic", "end", "12 ms"),))
    assert len(run.contacts["time"]) > 20
    assert run.summary["energy_residual_max"] < 1e-7 * run.summary["energy_max"]


@pytest.mark.parametrize("step, onsets, relative", [("2 us", 2e-7, 1e-3), ("1 us", 2e-8, 1e-4)])
def test_fixed_steps(gudgeon, step, onsets, relative):
    """RK4 at the step of the deck; its steps are as many as the time holds, and one more for each event."""
    run = finished(gudgeon, "--method", "rk4", changes=(SHORT, ("analysis.dynamic", "step", step)))
    assert run.summary["method"] == "rk4"
    check_impacts(run, onsets, relative)
    full = 3.4e-3 / (float(step.split()[0]) * 1e-6)
    assert full <= run.summary["steps"] <= full + run.summary["events"] + 1
    assert run.summary["rejected_steps"] == 0


def test_constraints_of_ida(gudgeon):
    """Positions and velocities stay on their constraints without stabilisation; Verner's drift without it."""
    off = (("analysis.dynamic", "stabilise", "none"), ("analysis.dynamic", "end", "12 ms"))
    held = finished(gudgeon, "--ideal", "--method", "ida", "--tolerance", "1e-6", changes=off).summary
    drifts = finished(gudgeon, "--ideal", "--tolerance", "1e-6", changes=off).summary
    assert held["violation_max"] < 1e-7
    assert drifts["violation_max"] > 3 * held["violation_max"]
