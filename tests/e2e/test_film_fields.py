"""Unwrapped films: figures and datasets asked for by `film(JOINT,...)`, and that asking changes nothing else."""

import functools

import h5py
import numpy as np
import pytest
from film_decks import BEARING, CLEARANCE
from scipy.integrate import trapezoid
from support import Run, assert_close, call, changed, scratch, written

RADIUS, LENGTH = 9.8e-3, 40e-3
WORDS = "film(bearing) film(bearing,least) film(bearing,20ms)"


@functools.lru_cache(maxsize=None)
def field_run(gudgeon, *options, words=WORDS, expect=0, **settings):
    """A short run of the journal bearing with figures of its film."""
    deck = written(scratch(), changed(BEARING.read_text(), "output", figures=words))
    out = scratch() / "out"
    given = {"duration": "25ms", **settings}
    pairs = [word for name, value in given.items() for word in ("--set", f"{name}={value}")]
    done = call(gudgeon, "run", deck, "--out", out, "--tolerance", "1e-10", *options, *pairs, expect=expect)
    return Run(out, done)


def force_of(group):
    """The force on the journal by the trapezium rule over pressures, world frame."""
    theta, y, p = group["theta"][:], group["y"][:], group["pressure"][:]
    angle = theta + group.attrs["bearing_angle"]
    along = trapezoid(p, y, axis=1)
    step = theta[1] - theta[0]
    return -RADIUS * step * np.array([(along[:-1] * np.cos(angle[:-1])).sum(), (along[:-1] * np.sin(angle[:-1])).sum()])


@pytest.mark.slow
@pytest.mark.parametrize("film, limit", [("short_sommerfeld", 1e-2), ("long_gumbel", 1e-2), ("short_exact", 1e-2), ("grid", 1e-2)])
def test_pressures_carry_the_film_force(gudgeon, film, limit):
    """At a time and at the end: the integral is the channel film_force; shapes, units, places, and the figures."""
    run = field_run(gudgeon, film=film)
    for name in ("film.bearing", "film.bearing.least", "film.bearing.20ms"):
        assert f"figures/{name}.png" in run.summary["figures"]
    forces = run.item("clearances/film_force", "bearing")
    eps = run.item("clearances/eccentricity_ratio", "bearing").ravel()
    with h5py.File(run.directory / "run.h5") as file:
        films = file["film_fields"]
        assert set(films) == {"film.bearing", "film.bearing.least", "film.bearing.20ms"}
        for name, row, moment in (("film.bearing", -1, "end of the run"), ("film.bearing.20ms", 20, "time")):
            group = films[name]
            assert group["pressure"].shape == group["gap"].shape == (361, 41)
            assert [group[key].attrs["units"] for key in ("theta", "y", "pressure", "gap")] == ["rad", "m", "Pa", "m"]
            assert_close(group.attrs["time"], run.time[row], absolute=1e-15)
            assert group.attrs["moment"] == moment and group.attrs["joint"] == "bearing" and group.attrs["film"] == film
            assert_close(force_of(group), forces[row], absolute=limit * np.hypot(*forces[row]), what=f"{film}, {name}")
            assert_close(group.attrs["eccentricity_ratio"], eps[row], absolute=1e-12)
            assert_close(group["gap"][:].min(), CLEARANCE * (1 - eps[row]), relative=1e-4)
            assert group.attrs["pressure_max"] == group["pressure"][:].max()
        least = films["film.bearing.least"]
        assert least.attrs["eccentricity_ratio"] >= eps.max() - 1e-5
        assert_close(least.attrs["time"], run.time[eps.argmax()], absolute=2e-3)


def test_asking_changes_nothing(gudgeon):
    """The motion and its cost are those of the run without such figures, bit for bit; but for the reports asked for."""
    plain, asked = field_run(gudgeon, words="bearing.orbit", film="grid"), field_run(gudgeon, film="grid")
    for path in ("bodies/position", "bodies/velocity", "clearances/film_force"):
        assert np.array_equal(plain.read(path), asked.read(path)), path
    assert plain.summary["steps"] == asked.summary["steps"]
    assert asked.summary["rhs_evaluations"] - plain.summary["rhs_evaluations"] <= 3


def test_grooves_stay_in_the_bearing(gudgeon):
    """Pressure in a groove is that of the supply, at its angle in the frame of the bearing."""
    text = BEARING.read_text().replace("[film.grid]\nname\ngrid", "[film.grid]\nname  supply  angle[deg]  width[deg]  pressure\ngrid  fixed  60  20  2bar")
    deck = written(scratch(), changed(text, "output", figures="film(bearing)"))
    out = scratch() / "out"
    run = Run(out, call(gudgeon, "run", deck, "--out", out, "--set", "film=grid", "--set", "duration=5ms", "--tolerance", "1e-8"))
    with h5py.File(run.directory / "run.h5") as file:
        pressure = file["film_fields/film.bearing/pressure"][:]
    assert_close(pressure[52:69, 20], 2e5, relative=1e-9, what="in the groove")
    assert_close(pressure[:, [0, 40]], 0, absolute=1e-9, what="at the ends")
    assert 0 < pressure[180, 20] < 1.999e5


def test_film_without_pressures_is_refused(gudgeon):
    """`finite` is a force without pressures, and `grid` is named."""
    deck = written(scratch(), changed(BEARING.read_text(), "output", figures=WORDS))
    done = call(gudgeon, "run", deck, "--set", "film=finite", "--out", scratch() / "out", expect=3)
    assert "no 'film(bearing)'" in done.stderr and "film.grid" in done.stderr


def test_missing_film_is_warned_of(gudgeon):
    """A joint that is ideal in this run has no film: a warning, and a film of the others."""
    text = changed(BEARING.read_text(), "output", figures="film(bearing)")
    out = scratch() / "out"
    run = Run(out, call(gudgeon, "run", written(scratch(), text), "--ideal", "--set", "duration=0.01s", "--set", "film=grid", "--out", out))
    assert any("'film(bearing)' omitted: the joint is ideal" in warning for warning in run.summary["warnings"])


def test_static_film(gudgeon):
    """A static analysis has one moment: the film at rest carries the load."""
    run = field_run(gudgeon, "--analysis", "static", words="film(bearing)", film="short_exact", duration="1s")
    with h5py.File(run.directory / "run.h5") as file:
        assert_close(force_of(file["film_fields/film.bearing"]), (0, 30 + 0.13 * 9.81), absolute=0.3, what="load")
    assert run.summary["figures"] == ["figures/film.bearing.png"]


def test_film_at_its_end(gudgeon):
    """A run that its film ends at eps_max leaves the film of that moment, and says which moment it did not reach."""
    text = changed(BEARING.read_text(), "output", figures="film(bearing) film(bearing,90ms)")
    text = text.replace("film_torque\n", "film_torque   eps_max\n").replace("{torque}\n", "{torque}   0.3\n")
    out = scratch() / "out"
    run = Run(out, call(gudgeon, "run", written(scratch(), text), "--out", out, "--set", "film=short_gumbel", "--set", "viscosity=40cP", expect=5))
    assert "film.bearing.90ms" in " ".join(run.summary["warnings"])
    with h5py.File(run.directory / "run.h5") as file:
        attributes = file["film_fields/film.bearing"].attrs
        assert_close(attributes["eccentricity_ratio"], 0.3, absolute=1e-6)
        assert attributes["time"] < 0.09
