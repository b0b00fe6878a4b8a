"""The ideal twin of the slider-crank against closed forms."""

import numpy as np
import pytest
from reference_values import CRANK_LENGTH, CRANK_SPEED, IDEAL, IDEAL_FIELDS, IDEAL_PEAKS, IDEAL_PERIOD, ROD_LENGTH
from support import assert_close, finished

REFERENCE = {field: np.array(column) for field, column in zip(IDEAL_FIELDS, zip(*IDEAL))}
EVERY = 1e-5  # output interval of the deck [s]
PART = 1e-9  # of each channel's peak


@pytest.fixture
def ideal(gudgeon):
    """The deck with every joint ideal."""
    return finished(gudgeon, "--ideal", "--tolerance", "1e-11")


def rows_of_table(ideal, turn):
    """Rows of the output that are the table's instants of a turn."""
    rows = np.rint((REFERENCE["time"] + turn * IDEAL_PERIOD) / EVERY).astype(int)
    assert_close(ideal.time[rows], REFERENCE["time"] + turn * IDEAL_PERIOD, absolute=1e-13, what="instants")
    return rows


@pytest.mark.parametrize("turn", [0, 1])
@pytest.mark.parametrize("quantity", ["position", "velocity", "acceleration"])
def test_slider(ideal, quantity, turn):
    """Position, velocity and acceleration of the slider along the guide; nothing across it."""
    rows = rows_of_table(ideal, turn)
    motion = ideal.item(f"bodies/{quantity}", "slider")[rows]
    assert_close(motion[:, 0], REFERENCE[quantity], absolute=PART * IDEAL_PEAKS[quantity], what=f"{quantity} along")
    assert_close(motion[:, 1], 0.0, absolute=PART * IDEAL_PEAKS[quantity], what=f"{quantity} across")


@pytest.mark.parametrize("turn", [0, 1])
def test_crank_moment(ideal, turn):
    """Moment of the motor on the crank, counter-clockwise positive."""
    rows = rows_of_table(ideal, turn)
    moment = ideal.item("drivers/moment", "motor")[rows]
    assert_close(moment, REFERENCE["moment"], absolute=PART * IDEAL_PEAKS["moment"], what="moment")


@pytest.mark.parametrize("turn", [0, 1])
def test_gudgeon_reaction(ideal, turn):
    """Force on the rod, which carries the journal, in the ideal gudgeon pin."""
    rows = rows_of_table(ideal, turn)
    force = ideal.item("clearances/force", "gudgeon")[rows]
    for k, axis in enumerate("xy"):
        expected = REFERENCE[f"force_{axis}"]
        assert_close(force[:, k], expected, absolute=PART * IDEAL_PEAKS["force"], what=f"force {axis}")


def test_every_instant_of_the_motion(ideal):
    """Two turns against x = l2 cos phi + sqrt(l3^2 - l2^2 sin^2 phi) and its derivatives."""
    phi = CRANK_SPEED * ideal.time
    sine, cosine = CRANK_LENGTH * np.sin(phi), CRANK_LENGTH * np.cos(phi)
    root = np.sqrt(ROD_LENGTH**2 - sine**2)
    root_1 = -sine * cosine / root
    root_2 = (sine**2 - cosine**2 - root_1**2) / root
    exact = {
        "position": cosine + root,
        "velocity": CRANK_SPEED * (root_1 - sine),
        "acceleration": CRANK_SPEED**2 * (root_2 - cosine),
    }
    for quantity, expected in exact.items():
        actual = ideal.item(f"bodies/{quantity}", "slider")[:, 0]
        assert_close(actual, expected, absolute=PART * IDEAL_PEAKS[quantity], what=quantity)


def test_ideal_joint_is_closed(ideal):
    """The ideal gudgeon has no eccentricity and no contacts."""
    assert np.abs(ideal.item("clearances/eccentricity", "gudgeon")).max() < 1e-9
    assert len(ideal.contacts) == 0
