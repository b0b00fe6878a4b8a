"""The bouncing ball and the slider loose in its guide, against independent solutions."""

import pytest
from support import ROOT, Run, call, scratch

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


def test_slider_corners(gudgeon):
    """Two corners touch at one instant, with the same force."""
    run = finished(gudgeon, "slider_crank_translational.deck", "--tolerance", "1e-10")
    rows = first_rows(run, 2)
    assert sorted(row["contact"] for row in rows) == ["C_upper", "D_upper"]
    for row in rows:
        assert float(row["time"]) == pytest.approx(8.137930103836e-4, abs=1e-9)
        assert float(row["impact_speed"]) == pytest.approx(1.765145468, rel=1e-6)
        assert float(row["peak_force"]) == pytest.approx(4852.770823, rel=1e-6)
