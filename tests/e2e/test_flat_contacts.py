"""The bouncing ball and the slider loose in its guide, against independent solutions."""

import numpy as np
import pytest
from support import ROOT, Run, call, scratch, written

# restitution: onset [s], impact speed [m/s], peak force [N], duration [s], rebound speed [m/s]; an independent integration
BALL = {
    "0.9": (0.4283529368781193, 4.2021423107743505, 114450.88137760991, 1.3027385067422982e-4, 3.837209858023114),
    "1": (0.4283529368781193, 4.2021423107743505, 119866.91080026948, 1.2899780057982444e-4, 4.2021423107743505),
    "0.5": (0.4283529368781193, 4.2021423107743505, 108543.41578370093, 1.344765914428423e-4, 3.0473048968811693),
}


def finished(program, deck, *options):
    """A run of a deck of inputs/."""
    directory = scratch()
    done = call(program, "run", ROOT / "inputs" / deck, "--out", directory / "out", "--quiet", *options)
    return Run(directory / "out", done)


def first_rows(run, n):
    """The first rows of events.dat: label and numbers by name."""
    names, rows = run.table("events.dat")
    return [dict(zip(names, row)) for row in rows[:n]]


@pytest.mark.parametrize("restitution", BALL)
def test_ball(gudgeon, restitution):
    """Onset, peak, duration and rebound of the first impact."""
    run = finished(gudgeon, "bouncing_ball.deck", "--tolerance", "1e-12", "--set", f"restitution={restitution}")
    (row,) = first_rows(run, 1)
    keys = ("time", "impact_speed", "peak_force", "duration", "release_speed")
    assert [float(row[key]) for key in keys] == pytest.approx(BALL[restitution], rel=1e-9)
    assert run.summary["factorisations"] == 0  # no joint, no matrix


def test_slider_corners(gudgeon):
    """Two corners touch at one instant, with the same force."""
    run = finished(gudgeon, "slider_crank_translational.deck", "--tolerance", "1e-10")
    rows = first_rows(run, 2)
    assert sorted(row["contact"] for row in rows) == ["C_upper", "D_upper"]
    for row in rows:
        assert float(row["time"]) == pytest.approx(8.137930103836e-4, abs=1e-9)
        assert float(row["impact_speed"]) == pytest.approx(1.765145468, rel=1e-6)
        assert float(row["peak_force"]) == pytest.approx(4852.770823, rel=1e-6)


def test_driver_tears_a_contact_loose(gudgeon):
    """Coulomb: no force at the contact holds what a driver moves; it slips all the time, at a reversal the other way at once: that is
    one row, since a stick that takes no time is none. The full force is against the motion, however slow."""
    text = (ROOT / "inputs/friction.deck").read_text()
    springs, material = text.index("[force.spring]"), text.index("[material]")
    text = (text[:springs] + "[driver.position]\nname i j axis position\ndrag rail seat x {5mm*sin(2*pi*t/1s)}\n\n"
            + text[material:])
    text = text.replace("pull    seat     {pull*sin(2*pi*t/1s)}   0N\n", "").replace("friction    = ambrosio", "friction = coulomb")
    directory = scratch()
    deck = written(directory, text)
    run = Run(directory / "out", call(gudgeon, "run", deck, "--out", directory / "out", "--quiet"))
    rows = first_rows(run, None)
    kinds = [(row["kind"], row["state_before"], row["state_after"]) for row in rows]
    assert kinds == [("contact", "free", "contact"), ("slip", "slip", "slip"), ("slip", "slip", "slip")]
    assert [float(row["time"]) for row in rows] == pytest.approx([0.0, 0.25, 0.75], abs=1e-12)
    force = run.read("clearances/contacts/friction_force")[:, 0]
    velocity = run.item("bodies/velocity", "shoe")[:, 0]
    moving = np.abs(velocity) > 1e-9
    assert moving.sum() >= len(velocity) - 2
    assert force[moving] == pytest.approx(-10.0*np.sign(velocity[moving]), rel=1e-6)
