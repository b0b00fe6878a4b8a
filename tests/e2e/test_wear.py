"""Wear of joints within a run: closed forms of a shaft in a bush, conservation and identities of a slider-crank with impacts."""

import functools
import json
import math

import h5py
import numpy as np
import pytest
from support import ROOT, assert_close, call, changed, plain_deck, scratch, written

LOAD, STIFFNESS, RADIUS, SHAFT, LENGTH = 100.0, 1e8, 10e-3, 9.5e-3, 15e-3
DEPTH = LOAD / STIFFNESS
SLID = 20 * math.pi * (SHAFT - DEPTH / 2)  # ten turns in a second; the force acts half-way between the surfaces
SHAFT_DECK = """
deck = 1
[scene]
gravity = 0 0 m/s^2
[bodies]
name    mass[kg]   inertia[kg.m^2]   y[mm]    omega[rpm]
shaft   1          1e-3              -0.501   600
[points]
name     body
bush     ground
centre   shaft
[material]
name    young[GPa]   poisson   density[kg/m^3]
steel   207          0.3       7850
[clearance.revolute]
name      bearing   journal   bearing_radius[mm]   clearance[mm]   length[mm]   material   law      wear
bearing   bush      centre    10                   0.5             15           steel      spring   dry
[contact.kelvin_voigt]
name     stiffness[N/m]   restitution
spring   1e8              1
[wear.archard]
name   bearing[m^2/N]   journal[mm^3/(N.m)]   WORDS
dry    1e-15            2e-6                  NUMBERS
[force.point]
name   point    fy
pull   centre   {-100 N}
[analysis.dynamic]
end       = 1 s
overlap   = preload
start     = given
tolerance = 1e-12
[output]
every    = 0.1 s
channels = bearing.normal_force
"""


def worn(program, text, *options):
    """The rows of /wear by joint and surface, and the cells of /wear_profiles."""
    directory = scratch()
    call(program, "run", written(directory, text), "--out", directory / "out", "--quiet", *options)
    with h5py.File(directory / "out/run.h5") as file:
        rows = {name: file[f"wear/{name}"][()] for name in file["wear"]}
        cells = {name: file[f"wear_profiles/{name}"][()] for name in file["wear_profiles"]}
        friction = file["energy/dissipated_friction"][-1] if "energy/dissipated_friction" in file else None
    pages = (ROOT / "docs/reference/output.md").read_text()
    assert all(f"`/wear/{name}`" in pages for name in rows) and all(f"`/wear_profiles/{name}`" in pages for name in cells)
    summary = json.loads((directory / "out/summary.json").read_text())["worn_surfaces"]
    surfaces = {}
    for k, key in enumerate(zip(rows["joint"], rows["surface"])):
        key = tuple(word.decode() for word in key)
        mine = np.array([(a.decode(), b.decode()) == key for a, b in zip(cells["joint"], cells["surface"])])
        surfaces[key] = {name: rows[name][k] for name in rows} | {f"cell_{name}": cells[name][mine] for name in cells}
        told = summary[k]
        assert (told["joint"], told["surface"]) == key and told["volume"] == surfaces[key]["volume"]
        assert_close(surfaces[key]["cell_volume"].sum(), surfaces[key]["volume"], relative=1e-14, what="cells")
        assert surfaces[key]["cell_volume"].min() >= 0 and surfaces[key]["cell_depth"].min() >= 0
    return surfaces, friction


def shaft(words="cells", numbers="360"):
    """The deck of the shaft with columns of its wear law."""
    return SHAFT_DECK.replace("WORDS", words).replace("NUMBERS", numbers)


def arc(depth):
    """Half angle of the arc of overlap, from the centre of the hole."""
    e = RADIUS - SHAFT + depth
    a = math.acos((RADIUS**2 - SHAFT**2 - e**2) / (2 * SHAFT * e))
    return math.atan2(SHAFT * math.sin(a), e + SHAFT * math.cos(a))


def test_shaft_in_a_bush(gudgeon):
    """Archard's law to round-off; the bush wears over the arc of contact as the cosine, the shaft evenly all round."""
    surfaces, _ = worn(gudgeon, shaft())
    bush, pin = surfaces["bearing", "bearing"], surfaces["bearing", "journal"]
    assert_close([bush["volume"], pin["volume"]], [1e-15 * LOAD * SLID, 2e-15 * LOAD * SLID], relative=1e-9, what="volume")
    assert_close([bush["distance"], pin["distance"]], SLID, relative=1e-9, what="distance")
    half = arc(DEPTH)
    edges = np.radians(np.arange(361.0)) - 1.5 * math.pi
    shares = np.diff(np.sin(np.clip(edges, -half, half))) / (2 * math.sin(half))
    assert_close(bush["cell_volume"] / bush["volume"], shares, absolute=1e-7, what="shares of the bush")
    assert_close(bush["depth_angle"], -math.pi / 2, absolute=math.radians(0.51), what="where the bush is deepest")
    assert_close(bush["arc"], 2 * half, relative=1e-4, what="arc")
    assert_close(pin["cell_volume"] * 360 / pin["volume"], 1, absolute=1e-6, what="shares of the shaft")
    assert_close(pin["depth_max"], pin["volume"] / (2 * math.pi * SHAFT * LENGTH), relative=1e-6, what="depth of the shaft")


def test_running_in_and_threshold(gudgeon):
    """Closed forms: the coefficient falls as exp(-s/s0); only the middle of the arc is above the threshold."""
    distance, first = 0.1, 5e-15
    surfaces, _ = worn(gudgeon, shaft("running_in[m]   bearing_first[m^2/N]", f"{distance}   {first}"))
    expected = LOAD * (1e-15 * SLID + (first - 1e-15) * distance * (1 - math.exp(-SLID / distance)))
    assert_close(surfaces["bearing", "bearing"]["volume"], expected, relative=1e-5, what="running-in")
    half = arc(DEPTH)
    greatest = LOAD / (LENGTH * RADIUS * (half + math.sin(half) * math.cos(half)))
    surfaces, _ = worn(gudgeon, shaft("threshold[Pa]", repr(0.999 * greatest)))
    part = math.sin(math.acos(0.999)) / math.sin(half)
    assert_close(surfaces["bearing", "bearing"]["volume"], 1e-15 * LOAD * SLID * part, relative=1e-5, what="threshold")
    surfaces, _ = worn(gudgeon, shaft("threshold[Pa]", repr(1.001 * greatest)))
    assert surfaces["bearing", "bearing"]["volume"] == 0 and surfaces["bearing", "bearing"]["depth_max"] == 0


LAWS = """
[friction.coulomb]
name      coefficient
coulomb   0.05
[wear.archard]
name      bearing[m^2/N]   journal[m^2/N]   cells
archard   1e-15            3e-15            {cells}
[wear.reye]
name   bearing[m^2/N]   journal[m^2/N]
reye   2e-14            6e-14
"""


def crank(method="auto", wear="archard", cells=360, **settings):
    """The dry slider-crank with Coulomb's friction and a wear law."""
    text = plain_deck().replace("law     friction\n", "law     friction   wear\n").replace("{law}   ambrosio", f"{{law}}   coulomb   {wear}")
    settings = {"end": "6 ms", "method": method, "tolerance": "1e-9"} | settings
    text = changed(changed(text, "analysis.dynamic", **settings), "output", channels="gudgeon.normal_force energy.*", every="0.1 ms")
    return changed(text, "parameters", cells=cells) + LAWS


@functools.lru_cache
def base(program):
    """The slider-crank by the default method, once."""
    return worn(program, crank())


def test_identity_with_the_ledger(gudgeon):
    """V = (k/mu) W of Coulomb's friction, to 1e-10; Reye's law with k/mu is the same, its volume the work to round-off."""
    surfaces, friction = base(gudgeon)
    for side, k in (("bearing", 1e-15), ("journal", 3e-15)):
        assert_close(surfaces["gudgeon", side]["volume"], k / 0.05 * friction, relative=1e-12, what=side)
    by_work, friction = worn(gudgeon, crank(wear="reye"))
    for side, k in (("bearing", 2e-14), ("journal", 6e-14)):
        assert_close(by_work["gudgeon", side]["volume"], k * friction, relative=1e-12, what=f"reye, {side}")
        assert_close(by_work["gudgeon", side]["cell_volume"], surfaces["gudgeon", side]["cell_volume"],
                     absolute=1e-6 * surfaces["gudgeon", side]["volume"], what=f"profiles, {side}")


@pytest.mark.parametrize("method", ["verner", "dop853", "radau", "bdf"])
def test_methods_agree(gudgeon, method):
    """Volumes and profiles are those of the motion, not of the method."""
    surfaces, _ = worn(gudgeon, crank(method))
    for key, surface in base(gudgeon)[0].items():
        assert_close(surfaces[key]["volume"], surface["volume"], relative=1e-4, what=f"{method}: volume of {key}")
        coarse = [s["cell_volume"].reshape(36, 10).sum(axis=1) for s in (surfaces[key], surface)]
        assert_close(coarse[0], coarse[1], absolute=1e-3 * surface["volume"], what=f"{method}: profile of {key}")


def test_cells(gudgeon):
    """The volume does not depend on the cells, and cells of cells have the sum."""
    for cells in (90, 1440):
        surfaces, _ = worn(gudgeon, crank(cells=cells))
        for key, surface in base(gudgeon)[0].items():
            assert_close(surfaces[key]["volume"], surface["volume"], relative=1e-12, what=f"{cells} cells: volume")
            coarse = [s["cell_volume"].reshape(90, -1).sum(axis=1) for s in (surfaces[key], surface)]
            assert_close(coarse[0], coarse[1], absolute=1e-3 * surface["volume"], what=f"{cells} cells: profile")


def test_restart_and_ideal(gudgeon):
    """A run that is interrupted wears the same, bit for bit; ideal joints do not wear."""
    directory = scratch()
    deck = written(directory, crank(method="verner", checkpoint="1 ms"))
    done = call(gudgeon, "run", deck, "--out", directory / "out", "--verify-restart")
    assert "equal bit for bit" in done.stdout and "Wear" in (directory / "out/summary.txt").read_text()
    call(gudgeon, "run", deck, "--set", "c=0.1mm", "--ideal", "--out", directory / "ideal", "--quiet")
    assert "worn_surfaces" not in json.loads((directory / "ideal/summary.json").read_text())


def test_groups(gudgeon):
    """Two shafts that nothing joins wear as each alone, also where one of them does not."""
    second = shaft().replace("shaft   1          1e-3              -0.501   600\n", "shaft   1          1e-3              -0.501   600\n"
                             "other   1          1e-3              -0.501   300\n")
    second = second.replace("centre   shaft\n", "centre   shaft\nmiddle   other\n").replace(
        "steel      spring   dry\n", "steel      spring   dry\nsecond    bush      middle    10                   0.5             15           steel      spring   WEAR\n")
    second = second.replace("pull   centre   {-100 N}\n", "pull   centre   {-100 N}\npush   middle   {-100 N}\n")
    alone, _ = worn(gudgeon, shaft())
    for wear in ("dry", "none"):
        surfaces, _ = worn(gudgeon, second.replace("WEAR", wear))
        assert len(surfaces) == (4 if wear == "dry" else 2)
        assert surfaces["bearing", "journal"]["volume"] == alone["bearing", "journal"]["volume"]
        if wear == "dry":
            assert_close(surfaces["second", "bearing"]["volume"], alone["bearing", "bearing"]["volume"] / 2, relative=1e-5, what="half as fast")
