"""Films of finite length in decks: where a journal comes to rest, against Butenschoen's table, and bearings that do not fit."""

import math
import re

import pytest
from film_decks import BEARING, CLEARANCE, film_run
from support import call, scratch

# L/D: eccentricity ratio, Sommerfeld number, angle between load and line of centres [deg]; p = 0 along the widest gap
TABLE = {1.0: (0.3, 0.4091, 68.264), 0.5: (0.5, 0.3124, 54.993)}
RADIUS, VISCOSITY, SPEED = 9.8e-3, 0.4, 500*math.pi/30
WEIGHT = 0.13*9.81
SUPPLIED = "[film.grid]\nname   supply       resolution\ngrid   widest_gap   coarse\n"


def bearing_deck(length="40", grid=None, tolerance="1e-13"):
    """The journal bearing with another length [mm], row of the grid, and tolerance."""
    text = re.sub(r"(\{c\} +)40( +lubricated)", rf"\g<1>{length}\g<2>", BEARING.read_text())
    if grid:
        text = text.replace("[film.grid]\nname\ngrid\n", grid)
    path = scratch() / "bearing.deck"
    path.write_text(text.replace("tolerance   = 1e-13", f"tolerance   = {tolerance}"))
    return path


@pytest.mark.parametrize("ratio", TABLE)
def test_rotation(gudgeon, ratio):
    """A load by the table's Sommerfeld number ends up at its eccentricity and angle, 0.5 % and 0.3 degrees."""
    eps, number, angle = TABLE[ratio]
    length = 2*RADIUS*ratio
    load = number*length*2*RADIUS*VISCOSITY*SPEED*(RADIUS/CLEARANCE)**2
    deck = bearing_deck(f"{1e3*length:.9g}", SUPPLIED, "1e-5")
    e = film_run(gudgeon, deck, film="grid", load=f"{load - WEIGHT:.9g}N", duration="0.4s").item("clearances/eccentricity", "bearing")[-1]
    assert math.hypot(*e)/CLEARANCE == pytest.approx(eps, rel=5e-3)
    assert math.degrees(math.atan2(e[0], -e[1])) == pytest.approx(angle, abs=0.3)


def test_finite_is_grid(gudgeon):
    """Quick film and grid go the same way, within 1 % of the eccentricity."""
    deck = bearing_deck(tolerance="1e-5", grid="[film.grid]\nname   resolution\ngrid   coarse\n")
    ends = [film_run(gudgeon, deck, film=film, duration="0.1s").item("clearances/eccentricity", "bearing")[-1]
            for film in ("finite", "grid")]
    assert math.dist(*ends) < 0.01*math.hypot(*ends[1])


def test_carries_the_load(gudgeon):
    """At rest in the end the film's force is the load."""
    force = film_run(gudgeon, BEARING, film="finite", duration="3s").item("clearances/film_force", "bearing")[-1]
    assert force[0] == pytest.approx(0, abs=1e-6)
    assert force[1] == pytest.approx(30 + WEIGHT, abs=1e-6)


def test_mistakes(gudgeon):
    """A bearing outside of the table, supplies that leave no film: the place is shown."""
    done = call(gudgeon, "check", bearing_deck("4"), "--set", "film=finite", expect=3)
    assert "L/D = 0.204082 is outside the range of 'finite', 0.25 to 4" in done.stderr and "^^^^^^ does not match" in done.stderr
    wide = bearing_deck(grid="[film.grid]\nname   supply   number   width[deg]\ngrid   fixed    5        70\n")
    done = call(gudgeon, "check", wide, "--set", "film=grid", expect=3)
    assert "5 supplies of this width leave no film: the maximum total is 324 deg" in done.stderr
