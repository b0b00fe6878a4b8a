"""The clearances and viscosities of section 5.7: the slider-crank with a film at the gudgeon pin, integrated by scipy on its own equations.

Crank at constant speed, rod of two freedoms less the guide: the rod turns about the crank pin, the slider slides, and the film of
Pinkus and Sternlicht between rod and slider takes the place of the pin. Nothing here comes from the program.
"""

import functools
import math

import numpy as np
import pytest
from film_decks import CRANK, film_run
from scipy.integrate import solve_ivp
from support import assert_close

OMEGA = 5000 * math.pi / 30  # rad/s
THROW, ROD, HALF = 0.05, 0.12, 0.06  # of crank and rod, and to the rod's centre [m]
ROD_MASS, ROD_INERTIA, SLIDER_MASS = 0.21, 2.5e-4, 0.14
LENGTH, BEARING = 40e-3, 10e-3
TURN = 2 * math.pi / OMEGA
INSTANTS = 600  # of a turn, 20 us each
CELLS = [(c, viscosity) for c in (0.5, 0.2, 0.1) for viscosity in (400, 40)]  # mm, cP


def film_force(e, e_dot, spin, c, viscosity):
    """Force on the journal, eqs. (5.14) to (5.18) for the entraining speed w_J + w_B and parting as well as approaching."""
    size = math.hypot(*e)
    n = (e[0] / size, e[1] / size) if size > 0 else (1.0, 0.0)
    eps, eps_dot = size / c, (e_dot[0] * n[0] + e_dot[1] * n[1]) / c
    w = (spin * size - 2 * (e_dot[1] * n[0] - e_dot[0] * n[1])) / c
    q = 1 - eps**2
    root, s = math.sqrt(q), 2 + eps**2
    speed = math.sqrt(q * ((w / 2) ** 2 + eps_dot**2))
    part = (speed + 3 * eps * max(eps_dot, 0.0)) / (speed + 1.5 * eps * abs(eps_dot)) if speed > 0 else 1.0
    scale = viscosity * LENGTH * (BEARING - c) ** 3 / c**2
    along = -6 * scale / (s * q * root) * (4 * eps * speed + math.pi * s * eps_dot * part)
    across = 6 * scale * math.pi * w * part / (s * root)
    return along * n[0] - across * n[1], along * n[1] + across * n[0]


@functools.lru_cache
def reference(c, viscosity, turns):
    """Least films of each turn at the output instants, and the eccentricity there."""

    def place(t, y):
        crank, rod = OMEGA * t, float(y[0])
        pin = THROW * math.cos(crank), THROW * math.sin(crank)
        reach = ROD * math.cos(rod), ROD * math.sin(rod)
        e = pin[0] + reach[0] - float(y[1]), pin[1] + reach[1]
        e_dot = -OMEGA * pin[1] - float(y[2]) * reach[1] - float(y[3]), OMEGA * pin[0] + float(y[2]) * reach[0]
        return pin, reach, e, e_dot

    def rates(t, y):
        pin, reach, e, e_dot = place(t, y)
        force = film_force(e, e_dot, float(y[2]), c * 1e-3, viscosity * 1e-3)
        pull = -OMEGA**2 * pin[0], -OMEGA**2 * pin[1]  # acceleration of the crank pin
        moment = reach[0] * force[1] - reach[1] * force[0] - ROD_MASS * HALF / ROD * (reach[0] * pull[1] - reach[1] * pull[0])
        return [y[2], y[3], moment / (ROD_INERTIA + ROD_MASS * HALF**2), -force[0] / SLIDER_MASS]

    instants = np.arange(turns * INSTANTS + 1) * TURN / INSTANTS
    start = [0.0, THROW + ROD, -OMEGA * THROW / ROD, 0.0]
    solution = solve_ivp(rates, (0, instants[-1]), start, method="Radau", t_eval=instants, rtol=1e-10, atol=1e-13)
    return np.array([place(t, y)[2] for t, y in zip(solution.t, solution.y.T)])


def least_films(gudgeon, c, viscosity, turns=10):
    """The run, and its least film of each turn [m]."""
    run = film_run(gudgeon, CRANK, "--tolerance", "1e-10", c=f"{c}mm", viscosity=f"{viscosity}cP", turns=turns)
    film = run.item("clearances/film_thickness", "gudgeon").ravel()
    return run, np.array([film[k * INSTANTS : (k + 1) * INSTANTS + 1].min() for k in range(turns)])


@pytest.mark.parametrize(("c", "viscosity"), CELLS)
def test_steady_from_turn_to_turn(gudgeon, c, viscosity):
    """The least film of the last turns is the same, in every cell; with the thickest film in the least gap that takes longest."""
    _, least = least_films(gudgeon, c, viscosity)
    assert 0 < least[-1] < c * 1e-3
    assert_close(least[-1], least[-2], relative=5e-5 if (c, viscosity) == (0.1, 400) else 5e-7, what="least film of the last turns")


@pytest.mark.parametrize(("c", "viscosity"), CELLS)
def test_beside_scipy(gudgeon, c, viscosity):
    """Eccentricity and least film of two turns as the independent integration has them, 1e-7 of the clearance."""
    run, least = least_films(gudgeon, c, viscosity, turns=2)
    e = reference(c, viscosity, 2)
    assert_close(run.item("clearances/eccentricity", "gudgeon"), e, absolute=1e-7 * c * 1e-3, what="eccentricity")
    film = c * 1e-3 - np.hypot(*e.T)
    expected = [film[k * INSTANTS : (k + 1) * INSTANTS + 1].min() for k in range(2)]
    assert_close(least, expected, relative=1e-6, what="least film")
