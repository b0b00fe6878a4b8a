"""Films that go over into dry contact, thin films that are told of, and loads that reverse."""

import numpy as np
import pytest
from film_decks import BEARING, CLEARANCE, CRANK, film_run
from support import assert_close, scratch, written

E_T0 = 5e-6  # of the slider-crank's deck [m]


def test_squeeze_film_and_contact(gudgeon):
    """The book's model: the film carries while it can, then the contact does, and the ledger closes through it all."""
    run = film_run(gudgeon, CRANK, level="hybrid", film="squeeze", turns=4)
    force, film = (run.item(f"clearances/{name}", "gudgeon") for name in ("force", "film_force"))
    distance = np.linalg.norm(run.item("clearances/eccentricity", "gudgeon"), axis=1)
    state = run.read("clearances/contacts/state").ravel()
    assert run.contacts.size >= 1
    assert {2, 3} <= set(state)
    assert np.all(np.isfinite(force))
    apart = distance < CLEARANCE
    assert_close(force[apart], film[apart], absolute=0, what="film alone")
    assert_close(film[distance > CLEARANCE + E_T0], 0, absolute=0, what="contact alone")
    energy = run.group("energy")
    assert_close(energy["residual"], 0, absolute=1e-6 * 172, what="ledger")
    assert energy["dissipated_film"][-1] > 0


@pytest.mark.parametrize("film", ["long_exact", "pinkus_sternlicht"])
def test_journal_pressed_through_the_film(gudgeon, film):
    """A film that ends at 0.9 of the clearance with contact behind it: the load is carried by both, without a jump at either end."""
    text = BEARING.read_text().replace("level        film     lubricant   film_torque", "level    film     lubricant   eps_max   material   law")
    text = text.replace("lubricated   {film}   oil         {torque}", "hybrid   {film}   oil         0.9       steel      dry")
    text = text.replace("[lubricant]", "[material]\nname young[GPa] poisson\nsteel 207 0.3\n[contact.lankarani_nikravesh]\n"
                        "name restitution\ndry 0.8\n[lubricant]")
    run = film_run(gudgeon, written(scratch(), text), "--tolerance", "1e-9", film=film, load="3e5N", duration="0.05s", speed="0rpm")
    eps = run.item("clearances/eccentricity_ratio", "bearing").ravel()
    assert eps[-1] > 1
    assert_close(run.item("clearances/force", "bearing")[-1], (0, 3e5 + 0.13 * 9.81), absolute=3e-3, what="load")
    assert set(run.read("clearances/contacts/state").ravel()[-10:]) == {3}
    assert_close(run.group("energy")["residual"], 0, absolute=1e-6 * 3e5 * CLEARANCE, what="ledger")


def test_thin_films_are_told_of(gudgeon):
    """A warning with limits and times; none where the film is thick."""
    thin = film_run(gudgeon, CRANK, viscosity="40cP", turns=1)
    words = [word for word in thin.summary["warnings"] if "film" in word]
    assert len(words) == 1
    assert "joint 'gudgeon'" in words[0] and "below 2.94 um (1.5e-4 of the journal diameter" in words[0] and "first at" in words[0]
    assert "Hamrock" not in words[0]
    least = thin.item("clearances/film_thickness", "gudgeon").min() * 1e6
    said = float(words[0].split("minimum thickness ")[1].split()[0])
    assert least - 0.01 < said <= least + 1e-3
    thick = film_run(gudgeon, CRANK, turns=1)
    assert not [word for word in thick.summary["warnings"] if "film" in word]


def test_roughness(gudgeon):
    """Twenty times the roughness is a limit of its own."""
    text = CRANK.read_text().replace("lubricant  e_t0 ", "lubricant  roughness[um]  e_t0 ").replace("oil        {e_t0}", "oil        6              {e_t0}")
    run = film_run(gudgeon, written(scratch(), text), turns=1)
    assert any("below 120 um (20 times the roughness)" in word for word in run.summary["warnings"])


@pytest.mark.parametrize("film", ["pinkus_sternlicht", "long_exact", "short_exact", "short_gumbel", "butenschoen"])
def test_load_that_reverses(gudgeon, film):
    """Twenty reversals a second, started from rest: finite, periodic in the end, and the ledger closes."""
    text = BEARING.read_text().replace("weight   centre   {-load}", "weight   centre   {200N*sin(125.66370614359172rad/s*t)}")
    run = film_run(gudgeon, written(scratch(), text), film=film, gumbel="corrected", duration="0.5s")
    eps = run.item("clearances/eccentricity_ratio", "bearing").ravel()
    assert 0.05 < eps.max() < 1
    if film not in ("butenschoen", "short_gumbel"):  # which are not dissipative
        assert_close(eps[450:], eps[400:451], absolute=1e-3, what="periodic")
    assert_close(run.group("energy")["residual"], 0, absolute=1e-8, what="ledger")
