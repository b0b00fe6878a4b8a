"""Sticking that is not unique: a warning names the contacts whose friction forces no motion tells apart; where these are unique, none.

Blocks rest on rigid feet, discs on planes: the rank of the sliding velocities of the contacts, as the bodies move in the plane, is that
of a small matrix made here from the places of the contacts.
"""

import sys

import numpy as np
import pytest
from support import ROOT, Run, call, scratch, written

sys.path.insert(0, str(ROOT / "tests" / "stability"))
import friction_runs  # noqa: E402
from random_friction import draw  # noqa: E402

HEAD = """deck = 1
[scene]
{space}gravity = {gravity} m/s^2
[analysis.dynamic]
start = given
overlap = preload
end = 0.05 s
tolerance = 1e-8
method = {method}
[output]
every = 1 ms
channels = energy.* b.position *.friction_force *.normal_force
[material]
name young[GPa] poisson
steel 207 0.3
[contact.lankarani_nikravesh]
name restitution
law 0.5
[friction.{friction}
"""
COULOMB = "coulomb]\nname coefficient static_coefficient\nfr 0.4 0.5\n"
LUGRE = "lugre]\nname coefficient static_coefficient\nfr 0.4 0.5\n"
BODY = "[bodies]\nname mass[kg] inertia[kg.m^2] x[m] y[m]\nb 1 1e-3 0 0\n[points]\nname body xi[m] eta[m]\n"
PLANES = "[clearance.plane]\nname plane ball axis axis_angle[rad] radius[m] material law friction\n"
RADIUS, SINK = 0.01, 1e-7


def feet(places, angles):
    """A block on balls at places of its own, each on a plane of its own whose normal has an angle to x."""
    points, planes = "", PLANES
    for k, (place, angle) in enumerate(zip(places, angles)):
        normal = np.array([np.cos(angle), np.sin(angle)])
        foot = np.asarray(place) - (RADIUS - SINK)*normal
        points += f"o{k} ground {float(foot[0])!r} {float(foot[1])!r}\nc{k} b {place[0]!r} {place[1]!r}\n"
        planes += f"f{k} o{k} c{k} x {angle!r} {RADIUS} steel law fr\n"
    return BODY + points + planes


def nullity(places, angles):
    """Friction forces of feet that hold one another: how many combinations have no resultant on the block."""
    columns = []
    for place, angle in zip(places, angles):
        normal = np.array([np.cos(angle), np.sin(angle)])
        t, at = np.array([-normal[1], normal[0]]), np.asarray(place) - RADIUS*normal
        columns.append([t[0], t[1], at[0]*t[1] - at[1]*t[0]])
    return len(places) - np.linalg.matrix_rank(np.array(columns), tol=1e-4)


UP = np.pi/2
SCENES = {  # places of the feet on the block, directions of the normals
    "two feet": ([(-0.05, -0.02), (0.05, -0.02)], [UP, UP]),
    "three feet": ([(-0.05, -0.02), (0.01, -0.02), (0.05, -0.02)], [UP, UP, UP]),
    "two heights": ([(-0.05, -0.03), (0.05, 0.02)], [UP, UP]),
    "corner": ([(-0.03, -0.03), (0.03, -0.03)], [np.pi/4, 3*np.pi/4]),
    "one foot": ([(0.0, -0.02)], [UP]),
}


def run_of(gudgeon, tables, method="verner", friction=COULOMB, gravity="0 -9.81", space=""):
    """A run."""
    directory = scratch()
    text = HEAD.format(gravity=gravity, method=method, friction=friction, space=space) + tables
    done = call(gudgeon, "run", written(directory, text), "--out", directory / "out", "--write", "channels")
    return Run(directory / "out", done)


def warning_of(run):
    """The warning of sticking that is not unique, blank if there is none."""
    found = [words for words in run.summary["warnings"] if "sticking contacts are not unique" in words]
    assert len(found) <= 1
    return found[0] if found else ""


@pytest.mark.parametrize("name", SCENES)
def test_named_where_forces_are_not_unique(gudgeon, name):
    """The contacts of a combination without a resultant are named, and no others."""
    places, angles = SCENES[name]
    words = warning_of(run_of(gudgeon, feet(places, angles)))
    assert bool(words) == (nullity(places, angles) > 0)
    for k in range(len(places)):
        assert (f"'f{k}'" in words) == bool(words)
    if words:
        assert "minimum-norm" in words and "friction.lugre" in words and "first at t =" in words


def test_shared_in_proportion_to_normal_forces(gudgeon):
    """On a slope each foot holds the same part of its normal force."""
    places, angles = [(-0.05, -0.02), (0.03, -0.02)], [UP, UP]
    run = run_of(gudgeon, feet(places, angles), gravity="1 -9.81")
    assert warning_of(run)
    normal, friction = (run.rows(f"clearances/contacts/{name}")[:, :2] for name in ("normal_force", "friction_force"))
    stuck = np.all(run.rows("clearances/contacts/normal_force")[:, :2] > 0.1, axis=1)
    part = np.abs(friction[stuck])/normal[stuck]
    assert len(part) > 20
    sliding = np.abs(part - 0.4) < 1e-9
    assert np.sum(~np.any(sliding, axis=1)) > 10
    for row in part[~np.any(sliding, axis=1)]:
        assert abs(row[0] - row[1]) < 1e-4*max(row)  # the heights of the feet differ by what they sink in


@pytest.mark.parametrize("method", ["bdf", "radau", "adams", "dop853", "rock4"])
def test_by_every_method(gudgeon, method):
    """Whatever the method."""
    assert "'f0' 'f1'" in warning_of(run_of(gudgeon, feet(*SCENES["two feet"]), method))
    assert not warning_of(run_of(gudgeon, feet(*SCENES["corner"]), method))


def test_bristles_determine_the_forces(gudgeon):
    """The way out that the warning names."""
    assert not warning_of(run_of(gudgeon, feet(*SCENES["two feet"]), "radau", LUGRE))


@pytest.mark.parametrize("method", ["verner", "bdf"])
@pytest.mark.parametrize("seed", [41, 99])
def test_three_pins_that_fall_straight(gudgeon, seed, method):
    """A body falls onto three pins at once, without sliding: their tangents are parallel, so two of the forces are enough."""
    scene, directory = draw("pin", seed), scratch()
    assert warning_of(friction_runs.run(gudgeon, scene, method, "coulomb", directory)).count("'j") == 3


SPACE = """[bodies]
name mass[kg] ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2] x[m] y[m] z[m]
b 1 1e-3 1e-3 1e-3 0 0 0
[points]
name body xi[m] eta[m] zeta[m]
"""


@pytest.mark.parametrize(("places", "normals"), [
    ([(-0.05, -0.03, -0.02), (0.05, -0.03, -0.02), (0.0, 0.05, -0.02)], [(0.0, 0.0, 1.0)]*3),
    ([(0.0, 0.0, 0.0), (0.0, 0.0, 0.0)], [(0.6, 0.0, 0.8), (-0.6, 0.0, 0.8)])])
def test_in_space(gudgeon, places, normals):
    """Three feet on a plane, and a ball in a groove: the rank is that of two tangents of each contact."""
    tables, planes, rows = SPACE, PLANES.replace("axis axis_angle[rad]", "axis_i"), []
    for k, (place, normal) in enumerate(zip(np.array(places), np.array(normals))):
        foot = place - (RADIUS - SINK)*normal
        for name, body, at in (("o", "ground", foot), ("c", "b", place)):
            tables += f"{name}{k} {body} " + " ".join(repr(float(x)) for x in at) + "\n"
        planes += f'f{k} o{k} c{k} "' + " ".join(repr(float(x)) for x in normal) + f'" {RADIUS} steel law fr\n'
        for t in np.linalg.svd(normal.reshape(1, 3))[2][1:]:
            rows.append([*t, *np.cross(place - RADIUS*normal, t)])
    missing = len(rows) - np.linalg.matrix_rank(np.array(rows), tol=1e-4)
    words = warning_of(run_of(gudgeon, tables + planes, space="space = spatial\n", gravity="0 0 -9.81"))
    assert bool(words) == (missing > 0)
    for k in range(len(places)):
        assert (f"'f{k}'" in words) == (missing > 0)
