"""What a film does beside its force: drag, power, side flow, rise of temperature, and the balance of heat of a static analysis.

References are closed forms of the half film of a short bearing and an iteration on them that shares nothing with the program.
"""

import math

import numpy as np
import pytest
from film_decks import BEARING, CLEARANCE, film_run
from support import assert_close, call, scratch, written

RADIUS, LENGTH, VISCOSITY = 9.8e-3, 40e-3, 0.4  # of the deck
SPEED = 500 * math.pi / 30  # rad/s
WEIGHT = 0.13 * 9.81
HEAT = 1.8e6  # J/(m^3.K)
VALUES = ("eccentricity_ratio", "drag_journal", "drag_bearing", "film_power", "side_flow", "temperature_rise")


def values(run):
    """Channels of the bearing at the last instant."""
    return {name: run.item(f"clearances/{name}", "bearing").ravel()[-1] for name in VALUES}


def static(gudgeon, deck=BEARING, *options, **settings):
    """The steady state of the bearing."""
    return film_run(gudgeon, deck, "--analysis", "static", *options, **settings)


@pytest.mark.parametrize("torque", ["on", "off"])
def test_short_film(gudgeon, torque):
    """Drag, power, flow and rise of the half film of a short bearing in closed form, whether the drag acts or not."""
    run = static(gudgeon, film="short_gumbel", load="500 N", torque=torque)
    found, force = values(run), run.item("clearances/film_force", "bearing")[-1]
    eps, e = found["eccentricity_ratio"], run.item("clearances/eccentricity", "bearing")[-1]
    shear = 2 * math.pi * VISCOSITY * LENGTH * RADIUS**3 / CLEARANCE * SPEED / math.sqrt(1 - eps**2)
    couple = (e[0] * force[1] - e[1] * force[0]) / 2
    assert_close(found["drag_journal"], -shear - couple, relative=1e-9, what="drag on the journal")
    assert_close(found["drag_bearing"], shear - couple, relative=1e-9, what="drag on the bearing")
    assert_close(found["film_power"], (shear + couple) * SPEED, relative=1e-9, what="power")
    assert_close(found["side_flow"], LENGTH * RADIUS * CLEARANCE * eps * SPEED, relative=1e-9, what="side flow")
    assert_close(found["temperature_rise"], found["film_power"] / (HEAT * found["side_flow"]), relative=1e-9, what="rise")
    acting = run.item("clearances/film_torque", "bearing").ravel()[-1]
    assert_close(acting, found["drag_journal"] if torque == "on" else 0, absolute=1e-15, what="moment that acts")


@pytest.mark.parametrize("film", ["finite", "grid", "pinkus_sternlicht"])
def test_flows_agree(gudgeon, film):
    """Flow of the fit beside that of the grid at the eccentricity of each film: rotation in L/D = 2.04, about half of a short bearing."""
    found = values(static(gudgeon, film=film, load="500 N"))
    part = found["side_flow"] / (LENGTH * RADIUS * CLEARANCE * found["eccentricity_ratio"] * SPEED)
    assert 0.63 < part < 0.72
    assert found["temperature_rise"] > 0


def test_power_is_what_the_ledger_books(gudgeon):
    """With the moments of shear the power of the film is the rate at which the ledger books its losses, also while it squeezes."""
    run = film_run(gudgeon, BEARING, film="finite", torque="on", duration="0.1s")
    rise = run.item("clearances/temperature_rise", "bearing").ravel()
    assert np.isnan(rise[0])  # it begins in the middle, where next to nothing leaves
    assert np.all(rise[1:] < 2)
    assert run.summary["warnings"] == []
    lost = run.read("energy/dissipated_film").ravel()
    power = run.item("clearances/film_power", "bearing").ravel()
    rate = np.gradient(lost, run.time)
    assert_close(power[20:-20], rate[20:-20], relative=1e-3, what="power")


GRADED = (("viscosity\noil    {viscosity}", "grade        temperature\noil    iso_vg_100   40degC"),
          ("film_torque\n", "film_torque   heat\n"), ("{torque}\n", "{torque}        {heat}\n"),
          ("duration    = 3 s", "duration    = 3 s\nheat        = balance"))


def graded_deck():
    """The bearing with an oil of a grade, and a balance of heat."""
    text = BEARING.read_text()
    for old, new in GRADED:
        assert old in text
        text = text.replace(old, new)
    return written(scratch(), text)


def grade_viscosity(celsius):
    """ISO VG 100 by Vogel's equation with the constants of DIN 31654."""
    least = 0.18e-3
    return least * math.exp((159.55657 / (celsius + 95) - 0.181913) * math.log(900 * 100e-6 / least))


def balance(load, speed):
    """Temperature, eccentricity and viscosity of the half film of a short bearing, by bisection in bisection."""

    def eccentricity(viscosity):
        scale = viscosity * LENGTH**3 * RADIUS / CLEARANCE**2 * speed
        low, high = 0.0, 1 - 1e-12
        for _ in range(200):
            e = (low + high) / 2
            carried = scale * e / (4 * (1 - e**2) ** 2) * math.sqrt(math.pi**2 * (1 - e**2) + 16 * e**2)
            low, high = (e, high) if carried < load else (low, e)
        return low

    def missing(celsius):
        viscosity = grade_viscosity(celsius)
        e = eccentricity(viscosity)
        across = viscosity * LENGTH**3 * RADIUS / CLEARANCE**2 * speed * math.pi * e / (4 * (1 - e**2) ** 1.5)
        drag = 2 * math.pi * viscosity * LENGTH * RADIUS**3 / CLEARANCE * speed / math.sqrt(1 - e**2) + e * CLEARANCE * across / 2
        rise = drag * speed / (HEAT * LENGTH * RADIUS * CLEARANCE * e * speed)
        return 40 + rise / 2 - celsius, e, viscosity

    low, high = 40.0, 200.0
    for _ in range(100):
        middle = (low + high) / 2
        low, high = (middle, high) if missing(middle)[0] > 0 else (low, middle)
    return low, *missing(low)[1:]


@pytest.mark.parametrize(("load", "rpm"), [(500, 3000), (2000, 20000)])
def test_balance_of_heat(gudgeon, load, rpm):
    """Temperature, viscosity and eccentricity of a film that heats itself."""
    run = static(gudgeon, graded_deck(), film="short_gumbel", load=f"{load - WEIGHT!r}N", speed=f"{rpm}rpm")
    film = run.summary["films"][0]
    celsius, eps, viscosity = balance(load, rpm * math.pi / 30)
    assert film["heated"]
    assert_close(film["temperature"] - 273.15, celsius, absolute=1e-5, what="temperature")
    assert_close(film["viscosity"], viscosity, relative=1e-6, what="viscosity")
    assert_close(film["eccentricity_ratio"], eps, relative=1e-6, what="eccentricity")
    assert "degC from the heat balance" in run.done.stdout
    cold = static(gudgeon, graded_deck(), film="short_gumbel", load=f"{load - WEIGHT!r}N", speed=f"{rpm}rpm", heat="off").summary["films"][0]
    assert not cold["heated"]
    assert_close(cold["viscosity"], grade_viscosity(40), relative=1e-9, what="viscosity of the lubricant")
    assert cold["eccentricity_ratio"] < eps


def test_balance_is_of_a_static_analysis(gudgeon):
    """A run in time keeps the temperature of the lubricant, and says so; explain too."""
    run = film_run(gudgeon, graded_deck(), film="finite", duration="1ms")
    assert any("heat = balance needs a static analysis" in warning for warning in run.summary["warnings"])
    said = call(gudgeon, "explain", graded_deck(), "--set", "film=finite").stdout
    assert "a static analysis computes the film temperature" in said
    assert "degC from the heat balance" in said


def test_balance_needs_a_grade(gudgeon):
    """An oil whose viscosity does not depend on the temperature has no balance."""
    text = graded_deck().read_text().replace("grade        temperature\noil    iso_vg_100   40degC", "viscosity\noil    {viscosity}")
    done = call(gudgeon, "check", written(scratch(), text), expect=3)
    assert "does not depend on temperature" in done.stderr
    assert "give the lubricant a grade" in done.stderr


def test_no_flow_no_balance(gudgeon):
    """A journal in the middle of its bearing presses nothing out: its heat has no balance."""
    text = graded_deck().read_text().replace("gravity  = 0 -9.81 m/s^2", "gravity  = 0 0 m/s^2")
    done = call(gudgeon, "run", written(scratch(), text), "--analysis", "static", "--set", "load=0N", "--set", "film=short_exact",
                "--out", scratch() / "out", expect=4)
    assert "film of joint 'bearing' has no side flow" in done.stderr


def test_other_heat_capacity(gudgeon):
    """The rise goes with one over density times heat capacity, in their units."""
    text = BEARING.read_text().replace("name   viscosity\noil    {viscosity}\n",
                                       "name   viscosity     density   heat_capacity\noil    {viscosity}   0.9g/cm^3  4kJ/(kg.K)\n")
    once, twice = (values(static(gudgeon, deck, film="finite"))["temperature_rise"] for deck in (BEARING, written(scratch(), text)))
    assert_close(twice, once / 2, relative=1e-9, what="rise")


@pytest.mark.parametrize("viscosity, in_the_mean", [("400 Pa.s", True), ("400 mPa.s", False)])
def test_too_hot(gudgeon, viscosity, in_the_mean):
    """A rise of the temperature beyond 150 K is a warning with its value, limit and what to do."""
    warnings = static(gudgeon, film="finite", load="500 N", viscosity=viscosity).summary["warnings"]
    told = [words for words in warnings if "temperature_rise" in words]
    assert len(told) == in_the_mean
    if told:
        rise = values(static(gudgeon, film="finite", load="500 N", viscosity=viscosity))["temperature_rise"]
        assert "limit 150 K" in told[0] and "lower viscosity" in told[0]
        assert_close(float(told[0].split("reaches ")[1].split(" K")[0]), rise, relative=1e-3, what="rise")


def test_film_without_pressures(gudgeon):
    """A channel of pressures is refused by name where the film has none."""
    deck = written(scratch(), BEARING.read_text().replace("bearing.* ", "bearing.film_pressure "))
    done = call(gudgeon, "check", deck, "--set", "film=finite", expect=3)
    assert "the film of 'bearing' has no pressure field" in done.stderr and "film.grid" in done.stderr
    call(gudgeon, "check", deck, "--set", "film=short_exact")
