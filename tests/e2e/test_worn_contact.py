"""Contact on worn surfaces in whole runs: profiles of no depth, energy, sliding past cells, tilted axes and methods."""

import functools

import numpy as np
import pytest
from support import ROOT, assert_close, run_with

BUMPS = '"' + " ".join(str(30 * k) for k in range(12)) + ' deg"   "' + " ".join(["0 10"] * 6) + ' um"'
SLIDING = f"""
deck = 1
[scene]
gravity = 0 0 m/s^2
[parameters]
tilt = TILT
[bodies]
name    mass[kg]   inertia[kg.m^2]   angle    x                       y                        vx                   vy                   omega[rad/s]
bush    1          1e-3              {{tilt}} 0m                    0m                     0m/s                 0m/s                 0
shaft   1          1e-3              {{tilt}} {{510.6um*sin(tilt)}}   {{-510.6um*cos(tilt)}}   {{50mm/s*cos(tilt)}} {{50mm/s*sin(tilt)}} 20
[points]
name     body
base     ground
hole     bush
centre   shaft
[joint.rigid]
name   i      j
base   base   hole
[material]
name    young[GPa]   poisson   density[kg/m^3]
steel   207          0.3       7850
[clearance.revolute]
name    bearing   journal   bearing_radius[mm]   clearance[mm]   length[mm]   material   law
plain   hole      centre    10                   0.5             15           steel      dry
[contact.hunt_crossley]
name   restitution
dry    0.2
[worn.profile]
name   joint   surface   angle   depth
a      plain   bearing   {BUMPS}
[force.point]
name   point    fx                  fy
pull   centre   {{100N*sin(tilt)}}  {{-100N*cos(tilt)}}
[analysis.dynamic]
end       = 4 ms
overlap   = preload
start     = given
tolerance = 1e-9
[output]
every    = 0.1 ms
channels = plain.normal_force plain.eccentricity plain.state
"""


def sliding(program, tilt=0, **settings):
    """A shaft pressed on a bush with twelve bumps, which it slides over."""
    return run_with(program, SLIDING.replace("TILT", f"{tilt} deg"), **settings)


def test_nothing_lost(gudgeon):
    """Profiles of no depth give the impacts of round surfaces."""
    deck = (ROOT / "inputs/slider_crank_dry.deck").read_text()
    new = deck + "\n[worn.uniform]\nname   joint     surface   depth[um]\na      gudgeon   bearing   0\nb      gudgeon   journal   0\n"
    round_pin, worn = (run_with(gudgeon, text, end="1.2 ms").contacts for text in (deck, new))
    assert len(worn) == len(round_pin) > 3
    for name in ("time", "impact_speed", "peak_force"):
        assert_close(worn[name], round_pin[name], relative=1e-7, what=name)


@functools.cache
def reference(program):
    """Where the shaft is by dop853."""
    return sliding(program, method="dop853").item("clearances/eccentricity", "plain")


@pytest.mark.parametrize("method", ["verner", "radau", "bdf"])
def test_methods(gudgeon, method):
    """Methods agree; a shaft that slides over bumps and cells has no impact, and the ledger closes."""
    run = sliding(gudgeon, method=method)
    away = np.abs(run.item("clearances/eccentricity", "plain") - reference(gudgeon))
    assert away.max() < 2e-10
    assert len(run.contacts) <= 1
    assert run.summary["energy_residual_max"] < 1e-8 * run.summary["energy_max"]


def test_tilted(gudgeon):
    """All of it turned by 25 degrees, bumps and load, is the same motion turned."""
    run = sliding(gudgeon, tilt=25)
    turn = np.deg2rad(25)
    there = run.item("clearances/eccentricity", "plain")
    back = np.column_stack([np.cos(turn) * there[:, 0] + np.sin(turn) * there[:, 1], np.cos(turn) * there[:, 1] - np.sin(turn) * there[:, 0]])
    assert np.abs(back - reference(gudgeon)).max() < 2e-10
