"""How far a pin sinks into a bush that is worn over ten degrees, against the same volume worn evenly all round."""

import math

import h5py
import pytest
from scipy.optimize import brentq
from support import call, scratch, written

RADIUS, PIN, HALF = 10e-3, 9.9e-3, math.radians(5.0)
CLEARANCE = RADIUS - PIN
DECK = """
deck = 1
[scene]
gravity = 0 0 m/s^2
[bodies]
name    mass[kg]   inertia[kg.m^2]   y[mm]
shaft   0.1        1e-5              -0.1003
[points]
name     body
hole     ground
centre   shaft
[material]
name    young[GPa]   poisson   density[kg/m^3]
steel   207          0.3       7850
[clearance.revolute]
name    bearing   journal   bearing_radius[mm]   clearance[mm]   length[mm]   material   law   wear
plain   hole      centre    10                   0.1             15           steel      dry   slow
[contact.hunt_crossley]
name   restitution
dry    0.2
[wear.archard]
name   bearing   journal   cells
slow   0m^2/N    0m^2/N    2880
[force.point]
name   point    fy
pull   centre   -0.01N
[analysis.static]
[output]
channels = shaft.position
"""


def eccentricity(program, worn=""):
    """Of the pin at rest under a small load."""
    directory = scratch()
    call(program, "run", written(directory, DECK + worn), "--out", directory / "out", "--quiet")
    with h5py.File(directory / "out/run.h5") as file:
        return -file["bodies/position"][-1, 0, 1]


def evenly(area):
    """Table of a depth all round that takes an area of the section."""
    return f"[worn.uniform]\nname joint surface depth[m]\na plain bearing {math.sqrt(RADIUS**2 + area / math.pi) - RADIUS}\n"


def circle():
    """Depth of the circle of the pin that is ten degrees wide, and the area of its section."""
    depth = brentq(lambda h: h * (2 * PIN - h) / (2 * RADIUS * (CLEARANCE + h)) - 1 + math.cos(HALF), 1e-9, 1e-4)
    off = CLEARANCE + depth
    angle = HALF + math.asin(off * math.sin(HALF) / PIN)
    return depth, PIN**2 * angle + off * PIN * math.sin(angle) - RADIUS**2 * HALF


@pytest.mark.parametrize("is_circle, ratio, close", [(False, 36.0, 1e-3), (True, 54.0, 1e-2)])
def test_local_against_uniform(gudgeon, is_circle, ratio, close):
    """36: ten degrees are a 36th of a turn. 54: the circle that a pin leaves is half as deep again as it is on average."""
    new = eccentricity(gudgeon)
    if is_circle:
        depth, area = circle()
        worn = f"[worn.arc]\nname joint surface depth[m] direction[deg]\na plain bearing {depth} -90\n"
    else:
        depth = 0.2e-6
        area = depth * (2 * RADIUS + depth) * HALF
        worn = f'[worn.profile]\nname joint surface angle depth\na plain bearing "-95.000001 -95 -85 -84.999999 deg" "0 {depth} {depth} 0 m"\n'
    found = (eccentricity(gudgeon, worn) - new) / (eccentricity(gudgeon, evenly(area)) - new)
    assert abs(found / ratio - 1) < close, found
