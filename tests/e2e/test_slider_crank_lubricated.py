"""The lubricated slider-crank of section 5.7: steady motion, the ideal joint beside it, levels, clearances and viscosities.

Numbers of the motion come from an independent program (LSODA on the same equations, other code); those of the ideal joint are closed forms.
"""

import numpy as np
import pytest
from film_decks import CLEARANCE, CRANK, film_run
from reference_values import IDEAL_PEAKS
from support import assert_close, scratch, written

TURN = 12e-3  # s
INSTANTS = 600  # of a turn


def last_turn(values, before=0):
    """The values of the last turn, or of one before it."""
    end = len(values) - before * INSTANTS
    return values[end - INSTANTS - 1 : end].ravel()


def of_joint(run, name):
    """A channel of the gudgeon pin."""
    return run.item(f"clearances/{name}", "gudgeon")


def test_steady_motion(gudgeon):
    """Least film, greatest eccentricity, peak moment beside that of the ideal joint, and a motion that repeats itself."""
    run = film_run(gudgeon, CRANK)
    assert_close(last_turn(of_joint(run, "film_thickness")).min(), 97.101e-6, absolute=0.005e-6, what="least film")
    assert_close(last_turn(of_joint(run, "eccentricity_ratio")).max(), 0.514496, absolute=2e-5, what="eccentricity")
    moment = run.item("drivers/moment", "motor")
    assert_close(np.abs(last_turn(moment)).max(), IDEAL_PEAKS["moment"], relative=2e-3, what="peak moment")
    for before in (0, 1):
        change = last_turn(of_joint(run, "eccentricity_ratio"), before) - last_turn(of_joint(run, "eccentricity_ratio"), before + 1)
        assert np.abs(change).max() < 1e-6 * 6.5**before
    fifth = of_joint(run, "film_thickness")[4 * INSTANTS : 5 * INSTANTS].min()
    assert_close(fifth, 97.101e-6, absolute=0.01e-6, what="fifth turn")
    assert run.contacts.size == 0
    assert_close(run.group("energy")["residual"], 0, absolute=1e-7 * 172, what="ledger")


def test_thickness_is_what_the_eccentricity_leaves(gudgeon):
    """Film thickness, eccentricity ratio and eccentricity tell the same, and nothing but the film acts."""
    run = film_run(gudgeon, CRANK)
    distance = np.linalg.norm(of_joint(run, "eccentricity"), axis=1)
    assert_close(of_joint(run, "eccentricity_ratio").ravel(), distance / CLEARANCE, absolute=1e-12)
    assert_close(of_joint(run, "film_thickness").ravel(), CLEARANCE - distance, absolute=1e-15)
    assert_close(of_joint(run, "force"), of_joint(run, "film_force"), absolute=0)
    assert set(run.read("clearances/contacts/state").ravel()) == {2}


# second turn, bearing on the rod: film, clearance, viscosity, entraining speed, greatest eccentricity, least film in um
SECOND_TURN = [
    ("pinkus_sternlicht", "0.2mm", "400cP", "inertial", 0.5091, 98.18),
    ("pinkus_sternlicht", "0.2mm", "400cP", "book", 0.4779, 104.43),
    ("long_exact", "0.2mm", "400cP", "inertial", 0.5096, 98.07),
    ("short_exact", "0.2mm", "400cP", "inertial", 0.3476, 130.47),
    ("pinkus_sternlicht", "0.2mm", "40cP", "inertial", 0.9853, 2.93),
    ("pinkus_sternlicht", "0.5mm", "400cP", "inertial", 0.9703, 14.86),
]


@pytest.mark.parametrize("film, c, viscosity, entrain, eccentricity, thickness", SECOND_TURN)
def test_second_turn(gudgeon, film, c, viscosity, entrain, eccentricity, thickness):
    """The bearing on the rod, which turns: the speed that entrains the film matters."""
    run = film_run(gudgeon, bearing_on_the_rod(entrain), film=film, c=c, viscosity=viscosity, turns=2)
    assert_close(last_turn(of_joint(run, "eccentricity_ratio")).max(), eccentricity, absolute=6e-5, what="eccentricity")
    assert_close(last_turn(of_joint(run, "film_thickness")).min() * 1e6, thickness, absolute=0.012, what="least film")


def test_steady_by_the_relative_speed(gudgeon):
    """The book's relative speed with the bearing on the rod: 7 % more film than there is."""
    run = film_run(gudgeon, bearing_on_the_rod("book"))
    assert_close(last_turn(of_joint(run, "film_thickness")).min(), 104.751e-6, absolute=0.005e-6, what="least film")


def bearing_on_the_rod(entrain):
    """The deck with bearing and journal changed over."""
    if entrain not in _decks:
        text = CRANK.read_text().replace("gudgeon  pin      small ", "gudgeon  small    pin   ")
        text = text.replace("lubricant  e_t0 ", "lubricant  entrain   e_t0 ").replace("oil        {e_t0}", f"oil        {entrain}   {{e_t0}}")
        _decks[entrain] = written(scratch(), text)
    return _decks[entrain]


_decks = {}


@pytest.mark.parametrize("c, viscosity", [("0.1mm", "400cP"), ("0.1mm", "40cP"), ("0.5mm", "40cP"), ("0.2mm", "4cP")])
def test_thin_and_thick_films(gudgeon, c, viscosity):
    """Whatever the film, the mean force on the slider is that of its motion, and the ledger closes."""
    run = film_run(gudgeon, CRANK, c=c, viscosity=viscosity, turns=3)
    assert of_joint(run, "film_thickness").min() > 0
    acceleration = run.item("bodies/acceleration", "slider")[:, 0]
    assert_close(of_joint(run, "force")[:, 0], -0.14 * acceleration, absolute=1e-6 * 2718.7, what="force on the journal")
    assert_close(run.group("energy")["residual"], 0, absolute=1e-6 * 172, what="ledger")


def test_implicit_method(gudgeon):
    """A stiff film by an implicit method: the same film as by an explicit one."""
    explicit = film_run(gudgeon, CRANK, viscosity="40cP", turns=2)
    implicit = film_run(gudgeon, CRANK, "--method", "bdf", "--tolerance", "1e-9", viscosity="40cP", turns=2)
    assert_close(of_joint(implicit, "film_thickness"), of_joint(explicit, "film_thickness"), absolute=1e-3 * CLEARANCE)


@pytest.mark.parametrize("level", ["clearance", "ideal"])
def test_other_levels(gudgeon, level):
    """One word, and the joint is dry or ideal: as in a deck that knows no film."""
    run = film_run(gudgeon, CRANK, level=level, turns=1, friction=0)
    if level == "ideal":
        assert_close(np.abs(run.item("drivers/moment", "motor")).max(), IDEAL_PEAKS["moment"], relative=1e-4, what="peak moment")
    else:
        assert run.contacts.size > 5
        assert_close(of_joint(run, "film_force"), 0, absolute=0)


def test_hybrid_far_from_the_wall(gudgeon):
    """A film with dry contact behind it is the film alone where it never comes to that."""
    alone = film_run(gudgeon, CRANK, turns=2)
    hybrid = film_run(gudgeon, CRANK, level="hybrid", e_t0="0mm", e_t1="0mm", turns=2)
    assert_close(of_joint(hybrid, "eccentricity"), of_joint(alone, "eccentricity"), absolute=1e-9)
    assert hybrid.contacts.size == 0


def test_stiff_film_is_told(gudgeon):
    """A squeeze film that creeps towards the wall: an explicit method is told why its steps are short, an implicit one is not."""
    explicit = film_run(gudgeon, CRANK, "--method", "verner", film="squeeze", turns=4)
    implicit = film_run(gudgeon, CRANK, "--method", "bdf", "--tolerance", "1e-9", film="squeeze", turns=4)
    assert explicit.summary["steps"] > 3 * implicit.summary["steps"]
    assert any(("'squeeze' is stiff" in words or "stiff for method = verner" in words) and "radau" in words for words in explicit.summary["warnings"])
    assert not any("stiff" in words for words in implicit.summary["warnings"])
    assert_close(of_joint(implicit, "film_thickness"), of_joint(explicit, "film_thickness"), absolute=1e-3 * CLEARANCE)
