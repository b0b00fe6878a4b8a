"""The journal bearing of section 5.6 against an independent program, closed forms, and its energy ledger.

Numbers of trajectories and equilibria are those of two integrators (LSODA, Radau) and of root finding on the closed forms, made by
a program that shares nothing with this one.
"""

import math
import re

import numpy as np
import pytest
from film_decks import BEARING, CLEARANCE, film_run
from support import assert_close, call, scratch, written

LOAD = 30 + 0.13 * 9.81  # N
SPEED = 500 * math.pi / 30  # rad/s
RADIUS, LENGTH, VISCOSITY = 9.8e-3, 40e-3, 0.4  # of the journal and of the oil

# film: eccentricity at t = 0.05 s and 0.1 s, over the clearance
POINTS = {
    "long_sommerfeld": ((0.0619903238756961, -0.080949591684284), (0.155071234696218, -0.0424750289115572)),
    "long_gumbel": ((0.485171359615844, -0.140825530257777), (0.209128658546435, 0.0522029653194444)),
    "short_sommerfeld": ((0.0445731110474684, -0.0580943826932644), (0.110908024509266, -0.0297211105298001)),
    "short_gumbel": ((0.0899671563882569, -0.101243751704025), (0.176456256661722, -0.0448479330291619)),
    "pinkus_sternlicht": ((0.105714919806138, -0.137253860410791), (0.240366669259034, -0.079523102467459)),
}
# films that come to rest: eccentricity in equilibrium, over the clearance
EQUILIBRIA = {
    "long_gumbel": (0.166350649422092, -0.0179727722807076),
    "short_gumbel": (0.116124907810076, -0.0174841261792872),
    "pinkus_sternlicht": (0.166350649422092, -0.0179727722807076),
    "long_exact": (0.166350649422092, -0.0179727722807076),  # without squeeze all half films of a length are the same
    "short_exact": (0.116124907810076, -0.0174841261792872),
}


def ratio(run):
    """Eccentricity over the clearance, as a vector."""
    return run.item("clearances/eccentricity", "bearing") / CLEARANCE


def peaks(run):
    """Maxima of the eccentricity ratio and their times, by parabolas through three instants."""
    eps, time = run.item("clearances/eccentricity_ratio", "bearing").ravel(), run.time
    top = [k for k in range(1, len(eps) - 1) if eps[k - 1] < eps[k] >= eps[k + 1]]
    shift = [(eps[k - 1] - eps[k + 1]) / (2 * (eps[k - 1] - 2 * eps[k] + eps[k + 1])) for k in top]
    values = [eps[k] - (eps[k - 1] - eps[k + 1]) * s / 4 for k, s in zip(top, shift)]
    return np.array(values), np.array([time[k] + s * (time[1] - time[0]) for k, s in zip(top, shift)])


@pytest.mark.parametrize("film", POINTS)
def test_trajectory(gudgeon, film):
    """The way from the middle, 1e-8 of the clearance."""
    run = film_run(gudgeon, BEARING, film=film, duration="0.1s")
    for instant, point in zip((50, 100), POINTS[film]):
        assert_close(ratio(run)[instant], point, absolute=1e-8, what=f"{film} at {run.time[instant]} s")


@pytest.mark.parametrize("film", EQUILIBRIA)
def test_equilibrium(gudgeon, film):
    """Where the journal comes to rest, and that it carries the load there."""
    run = film_run(gudgeon, BEARING, film=film, duration="4s")
    assert_close(ratio(run)[-1], EQUILIBRIA[film], absolute=1e-6, what=f"{film}: equilibrium")
    assert_close(run.item("clearances/film_force", "bearing")[-1], (0, LOAD), absolute=1e-4, what="load")
    thickness = run.item("clearances/film_thickness", "bearing")[-1]
    assert_close(thickness, CLEARANCE * (1 - math.hypot(*EQUILIBRIA[film])), absolute=1e-9, what="film thickness")


def test_load_is_carried():
    """The load that the book plots."""
    assert_close(LOAD, 31.2753, absolute=1e-12)


@pytest.mark.parametrize("tolerance", ["1e-11", "1e-13"])
def test_whirl_of_a_full_film(gudgeon, tolerance):
    """A full film has no damping: the journal whirls at about half the speed, and its mass makes that grow, at any tolerance."""
    run = film_run(gudgeon, BEARING, "--tolerance", tolerance, film="long_sommerfeld", duration="2s")
    tops, times = peaks(run)
    assert_close(tops[0], 0.166584, absolute=5e-7, what="greatest eccentricity")
    assert_close(1 / np.diff(times), 4.144934, absolute=2e-6, what="frequency")
    assert_close(tops[1:] / tops[:-1] - 1, 1.45e-4, absolute=2e-6, what="growth per orbit")
    assert 0.99 < 4.144934 / (SPEED / (4 * math.pi)) < 1


def test_whirl_of_a_short_film(gudgeon):
    """The same of a short bearing: closer to half the speed."""
    run = film_run(gudgeon, BEARING, film="short_sommerfeld", duration="1s")
    tops, times = peaks(run)
    assert_close(tops[:4], [0.11870930836, 0.11872146699, 0.11873362804, 0.11874579148], absolute=1e-8, what="greatest eccentricity")
    assert_close(1 / np.diff(times), 4.166666652812679, absolute=1e-6, what="frequency")


@pytest.mark.parametrize("film", ["short_gumbel", "long_gumbel", "pinkus_sternlicht", "short_exact", "long_exact", "butenschoen"])
def test_other_sense(gudgeon, film):
    """With the other sense of the shaft the journal goes the mirrored way."""
    forward = film_run(gudgeon, BEARING, film=film, gumbel="corrected", duration="0.1s")
    backward = film_run(gudgeon, BEARING, film=film, gumbel="corrected", duration="0.1s", speed="-500rpm")
    assert_close(ratio(backward), ratio(forward) * (-1, 1), absolute=2e-8, what=film)


def test_squeeze_film_carries_nothing(gudgeon):
    """A squeeze film has no equilibrium: the journal sinks, as slowly as (1 - eps^2)^(3/2) lets it."""
    run = film_run(gudgeon, BEARING, film="squeeze", duration="2s")
    eps = run.item("clearances/eccentricity_ratio", "bearing").ravel()
    assert np.all(np.diff(eps[5:]) > 0)
    rate = 12 * math.pi * VISCOSITY * LENGTH * RADIUS**3 / CLEARANCE**2 * np.gradient(eps, run.time) / (1 - eps**2) ** 1.5
    assert_close(rate[100:-1], LOAD, relative=1e-4, what="quasi-static")


@pytest.mark.parametrize("film", ["pinkus_sternlicht", "long_sommerfeld"])
def test_work_of_the_shaft(gudgeon, film):
    """With the moments of shear: the motor gives what the film takes, and the ledger closes."""
    run = film_run(gudgeon, BEARING, film=film, torque="on", duration="3s")
    energy = run.group("energy")
    assert energy["drive_work"][-1] > 1
    assert np.all(np.diff(energy["dissipated_film"].ravel()) > 0)
    assert_close(energy["residual"], 0, absolute=1e-9 * energy["drive_work"][-1], what="residual")
    eps = run.item("clearances/eccentricity_ratio", "bearing").ravel()
    drag = 2 * math.pi * VISCOSITY * LENGTH * RADIUS**3 / CLEARANCE * SPEED / np.sqrt(1 - eps**2)
    e, f = run.item("clearances/eccentricity", "bearing"), run.item("clearances/film_force", "bearing")
    moment = drag + (e[:, 0] * f[:, 1] - e[:, 1] * f[:, 0]) / 2
    assert_close(run.item("drivers/moment", "motor").ravel(), moment, relative=1e-6, what="moment of the motor")


def test_full_film_feeds_the_whirl(gudgeon):
    """Without the moments of shear the energy of the whirl comes from nowhere but the film: what it takes is negative, orbit by orbit."""
    run = film_run(gudgeon, BEARING, film="long_sommerfeld", duration="2s")
    energy = run.group("energy")
    assert_close(energy["residual"], 0, absolute=1e-10, what="residual")
    _, times = peaks(run)
    at_tops = np.interp(times, run.time, energy["dissipated_film"].ravel())
    tops, _ = peaks(run)
    assert tops[-1] > tops[0]
    assert at_tops[-1] < at_tops[0]


def test_film_ends(gudgeon):
    """A load that reverses the squeeze film's journal into the wall: a clear end that names joint, time and eccentricity."""
    done = call(gudgeon, "run", BEARING, "--out", scratch() / "out", "--set", "film=squeeze", "--set", "viscosity=0.01cP",
                "--set", "load=3e4 N", expect=5)
    assert re.search(r"film of joint 'bearing' \(squeeze\) reached its limit: the eccentricity is 0\.99999 times the clearance", done.stderr)
    assert re.search(r"at t = \S+ s", done.stderr)
    assert "level = hybrid" in done.stderr
    assert "NaN" not in done.stderr


def test_start_in_the_wall(gudgeon):
    """A journal that lies against the wall has no film to begin with."""
    text = BEARING.read_text().replace("journal   0.13       2.5e-4            0       0", "journal   0.13       2.5e-4            0.2     0")
    deck = written(scratch(), text.replace("end         =", "start       = given\nend         ="))
    done = call(gudgeon, "run", deck, "--out", deck.parent / "out", expect=(3, 4, 5))
    assert "bearing" in done.stderr


@pytest.mark.parametrize("grade, temperature, viscosity", [("iso_vg_46", "40degC", 0.0414), ("iso_vg_46", "100degC", 0.00573),
                                                           ("iso_vg_220", "60degC", 0.0681), ("sae_30", "40degC", 0.0902)])
def test_grades(gudgeon, grade, temperature, viscosity):
    """Viscosities of grades: VG is 900 kg/m^3 times VG mm^2/s at 40 degC, the others by their formulas, worked out by hand."""
    text = BEARING.read_text().replace("name   viscosity\noil    {viscosity}", f"name   grade   temperature\noil    {grade}   {temperature}")
    done = call(gudgeon, "explain", written(scratch(), text))
    said = float(re.search(r"viscosity (\S+) Pa.s", done.stdout).group(1))
    assert_close(said, viscosity, relative=2e-3, what=grade)


@pytest.mark.parametrize("film", [*EQUILIBRIA, "long_sommerfeld", "short_sommerfeld"])
def test_static_equilibrium(gudgeon, film):
    """Where the journal comes to rest, without a motion: full films too, from which no motion gets there."""
    expected = {"long_sommerfeld": (0.0841696123391651, 0), "short_sommerfeld": (0.0602981603934902, 0), **EQUILIBRIA}[film]
    run = film_run(gudgeon, BEARING, "--analysis", "static", film=film)
    assert_close(ratio(run)[-1], expected, absolute=1e-9, what=f"{film}: equilibrium")
    assert_close(run.item("clearances/film_force", "bearing")[-1], (0, LOAD), absolute=1e-9, what="load")


def test_static_equilibrium_near_the_wall(gudgeon):
    """A hundred times the load: Newton's iteration from the middle stays within the clearance."""
    run = film_run(gudgeon, BEARING, "--analysis", "static", film="short_exact", load="3000N")
    eps = run.item("clearances/eccentricity_ratio", "bearing").ravel()[-1]
    assert 0.8 < eps < 1
    force = run.item("clearances/film_force", "bearing")[-1]
    assert_close(force, (0, 3000 + 0.13 * 9.81), absolute=1e-6, what="load")
    scale = VISCOSITY * LENGTH**3 * RADIUS / CLEARANCE**2 * SPEED
    q = 1 - eps**2
    assert_close(math.hypot(*force) / scale, eps / (4 * q**2) * math.sqrt(16 * eps**2 + math.pi**2 * q), relative=1e-9, what="Ocvirk")
