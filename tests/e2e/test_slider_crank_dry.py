"""The slider-crank with a dry, loose gudgeon pin, against an independent solution."""

import numpy as np
import pytest
from reference_values import CLEARANCE, IMPACT_FIELDS, IMPACTS, STIFFNESS
from support import assert_close, finished

REFERENCE = {field: np.array(column) for field, column in zip(IMPACT_FIELDS, zip(*IMPACTS))}


@pytest.fixture
def tight(gudgeon):
    """The run at tolerance 1e-10."""
    return finished(gudgeon, "--tolerance", "1e-10")


@pytest.fixture
def loose(gudgeon):
    """The run at tolerance 1e-6."""
    return finished(gudgeon, "--tolerance", "1e-6")


def onsets_of_table(run):
    """Onsets of contact as events.dat tells them."""
    names, rows = run.table("events.dat")
    time, kind = names.index("time"), names.index("kind")
    return sorted(float(row[time]) for row in rows if row[kind] == "contact")


def test_run_is_complete(tight):
    """The run reached its end and says so."""
    assert tight.summary["status"] == "complete"
    assert tight.time[0] == 0.0
    assert_close(tight.time[-1], 0.024, absolute=1e-12, what="end")
    assert len(tight.time) == 2401
    assert_close(np.diff(tight.time), 1e-5, absolute=1e-13, what="uniform grid")


def test_first_ten_onsets(tight):
    """At tolerance 1e-10 the first ten onsets are right to 2 ns."""
    assert_close(tight.contacts["time"][:10], REFERENCE["time"], absolute=2e-9, what="onsets")


def test_first_ten_onsets_in_text(tight):
    """So are those of events.dat."""
    assert_close(onsets_of_table(tight)[:10], REFERENCE["time"], absolute=2e-9, what="onsets in events.dat")


@pytest.mark.parametrize("field", ["impact_speed", "peak_force"])
def test_first_five_impacts(tight, field):
    """Impact speeds and located peak forces of the first five impacts to a millionth."""
    assert_close(tight.contacts[field][:5], REFERENCE[field][:5], relative=1e-6, what=field)


def test_release_of_first_five_impacts(tight):
    """Ends of contact, speeds there and the energy that went into damping."""
    assert_close(tight.contacts["duration"][:5], REFERENCE["duration"][:5], absolute=2e-9, what="duration")
    for field in ("release_speed", "energy_lost"):
        assert_close(tight.contacts[field][:5], REFERENCE[field][:5], relative=2e-6, what=field)


def test_loose_tolerance(loose):
    """At tolerance 1e-6 the first four onsets are right to 1 us, in both files."""
    assert_close(loose.contacts["time"][:4], REFERENCE["time"][:4], absolute=1e-6, what="onsets")
    assert_close(onsets_of_table(loose)[:4], REFERENCE["time"][:4], absolute=1e-6, what="onsets in events.dat")


def test_penetration_and_force_of_the_law(tight):
    """Peak force is near Hertz' force of the peak penetration; a free contact carries none, a closed one never pulls."""
    contacts = tight.contacts[:5]
    hertz = STIFFNESS * contacts["peak_penetration"] ** 1.5
    assert np.all(np.abs(contacts["peak_force"] / hertz - 1.0) < 0.1)
    normal = tight.read("clearances/contacts/normal_force")
    depth = tight.read("clearances/contacts/penetration")
    assert normal.min() >= 0.0
    assert np.all(normal[depth == 0.0] == 0.0)
    assert normal.max() > 1e4


def test_force_follows_the_law(tight):
    """In every recorded instant of the first impact F = K d^1.5 (1 + 3 (1 - e^2)/4 d'/v)."""
    start, end = REFERENCE["time"][0], REFERENCE["time"][0] + REFERENCE["duration"][0]
    inside = (tight.time > start) & (tight.time < end)
    assert inside.sum() == 6
    depth, rate, force = (
        tight.read(f"clearances/contacts/{name}")[inside, 0] for name in ("penetration", "penetration_rate", "normal_force")
    )
    law = STIFFNESS * depth**1.5 * (1.0 + 0.75 * (1.0 - 0.9**2) * rate / REFERENCE["impact_speed"][0])
    assert_close(force, law, relative=1e-8, what="normal force")


def test_eccentricity_and_penetration_agree(tight):
    """Penetration is the eccentricity beyond the clearance, and 0 when apart."""
    eccentricity = np.linalg.norm(tight.item("clearances/eccentricity", "gudgeon"), axis=-1)
    depth = tight.read("clearances/contacts/penetration")[:, 0]
    assert_close(depth, np.maximum(eccentricity - CLEARANCE, 0.0), absolute=1e-15, what="penetration")


def test_table_of_the_gudgeon_equals_the_file(tight):
    """gudgeon.dat holds what run.h5 holds."""
    names, rows = tight.table("gudgeon.dat")
    values = np.array([[float(cell) for cell in row] for row in rows if len(row) == len(names)], float)
    force = tight.rows("clearances/force")[:, list(tight.read("clearances/names")).index("gudgeon")]
    column = next(i for i, name in enumerate(names) if name.endswith("force.x") and "friction" not in name)
    assert_close(values[:, names.index("time")], tight.rows("time"), absolute=1e-14, what="time")
    assert_close(values[:, column], force[:, 0], absolute=1e-8, relative=1e-9, what=names[column])
