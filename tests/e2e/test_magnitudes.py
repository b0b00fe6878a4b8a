"""Magnitudes of vectors as channels, the ranked table of forces, and forces of mechanisms that have none."""

import functools
import json

import numpy as np
import pytest
from support import ROOT, Run, call, changed, plain_deck, scratch, written

# A rotor that turns about its centre of mass; nothing acts on it, so that the reaction of its pin is nothing but rounding.
ROTOR = """deck = 1
[scene]
gravity = 0 0 m/s^2
[bodies]
name   mass[kg]  inertia[kg.m^2]  x[m]  y[m]  omega[rad/s]
rotor  0.3       0.1              0.1   0.7   7.3
[points]
name   body    xi[m]  eta[m]
floor  ground  0.1    0.7
hub    rotor   0      0
rim    rotor   0.2    0
[joint.revolute]
name  i      j
pin   floor  hub
[analysis.dynamic]
end = 0.2 s
[output]
every = 2 ms
"""


@functools.lru_cache(maxsize=None)
def crank(program):
    """Half a turn of the dry slider-crank: magnitudes beside their components, and requests that use them."""
    text = changed(changed(plain_deck(), "analysis.dynamic", end="6 ms"), "output", channels="* gudgeon.force.magnitude *.velocity.magnitude request.*")
    text += "\n[request]\nname   value\ntwice  {2*gudgeon.force.magnitude}\n"
    directory = scratch()
    call(program, "run", written(directory, text), "--set", "restitution=0.8", "--out", directory / "out", "--quiet")
    return Run(directory / "out")


def test_magnitudes_are_roots_of_sums(gudgeon):
    """Each is that of the vector in the same row, in run.h5 and in the text files, of contact rows too."""
    run = crank(gudgeon)
    force = np.linalg.norm(run.read("clearances/force"), axis=-1)
    assert force.max() > 0.0
    np.testing.assert_allclose(run.read("clearances/force.magnitude"), force, rtol=1e-15)
    np.testing.assert_allclose(run.read("bodies/velocity.magnitude"), np.linalg.norm(run.read("bodies/velocity"), axis=-1), rtol=1e-15)
    np.testing.assert_allclose(np.ravel(run.read("requests/twice")), 2.0*force[:, 0], rtol=1e-15)
    table = np.genfromtxt(run.directory / "gudgeon.dat", names=True)
    np.testing.assert_allclose(table["gudgeonforcemagnitudeN"], np.hypot(table["gudgeonforcexN"], table["gudgeonforceyN"]), rtol=1e-15)


def test_only_where_it_is_named(gudgeon):
    """`*` and `X.force` are without magnitudes; a component that is not there is a message."""
    directory = scratch()
    text = changed(changed(plain_deck(), "analysis.dynamic", end="1 ms"), "output", channels="gudgeon.* rod.velocity")
    call(gudgeon, "run", written(directory, text), "--out", directory / "out", "--quiet")
    run = Run(directory / "out")
    with pytest.raises(KeyError):
        run.read("clearances/force.magnitude")
    text = changed(plain_deck(), "output", channels="gudgeon.force.magnitud")
    assert "has no component 'magnitud'" in call(gudgeon, "run", written(directory, text), expect=3).stderr


def test_largest_forces_are_ranked(gudgeon):
    """One row for each item, the largest first, not below any row of the history; alike in all files."""
    run = crank(gudgeon)
    told = run.summary["largest_forces"]
    assert [entry["channel"] for entry in told] == list(run.read("extremes/forces/name"))
    forces = [entry["force"] for entry in told]
    assert forces == sorted(forces, reverse=True) and np.array_equal(forces, run.read("extremes/forces/force"))
    assert np.array_equal([entry["time"] for entry in told], run.read("extremes/forces/time"))
    items = [entry["channel"].split(".")[0] for entry in told]
    assert len(set(items)) == len(items) and "gudgeon" in items
    names = [str(name) for name in run.read("joints/names")]
    vectors = np.linalg.norm(run.read("joints/force"), axis=-1)
    for number, name in enumerate(names):
        entry = told[items.index(name)]
        assert entry["channel"] == f"{name}.force.magnitude"
        assert entry["force"] >= vectors[:, number].max()*(1.0 - 1e-14)
        nearest = np.abs(run.read("time") - entry["time"]).argmin()
        assert vectors[nearest, number] == pytest.approx(entry["force"], rel=0.05)
    text = (run.directory / "summary.txt").read_text()
    assert text.index("largest forces") < text.index("joints with clearance") < text.index("extremes")
    extremes = [entry["unit"] for entry in run.summary["extremes"]]
    forces = [unit in ("N", "N.m") for unit in extremes]
    assert forces == sorted(forces, reverse=True)


def test_no_force_is_no_result(gudgeon):
    """What rounding makes of a reaction that is not there is in no table for people; run.h5 keeps its numbers."""
    directory = scratch()
    call(gudgeon, "run", written(directory, ROTOR), "--out", directory / "out", "--quiet")
    run = Run(directory / "out")
    assert 0.0 <= np.abs(run.read("joints/force")).max() < 1e-12
    assert run.summary["largest_forces"] == []
    text = (run.directory / "summary.txt").read_text()
    assert "pin.force" not in text and "rotor.angular_velocity" in text


def test_directions_of_frames_do_not_matter(gudgeon):
    """In space the magnitude of a reaction is that of its components along the axes of the joint."""
    directory = scratch()
    text = changed((ROOT / "inputs/four_bar_spatial.deck").read_text(), "output", figures=None,
                   channels="*.force.magnitude *.joint_force")
    text = changed(text, "analysis.dynamic", end="20 ms")
    call(gudgeon, "run", written(directory, text), "--out", directory / "out", "--quiet")
    run = Run(directory / "out")
    along = run.read("joints/joint_force")
    has = ~np.isnan(along).any(axis=(0, 2))
    np.testing.assert_allclose(run.read("joints/force.magnitude")[:, has], np.linalg.norm(along, axis=-1)[:, has], rtol=1e-9, atol=1e-9)
    assert json.loads((run.directory / "summary.json").read_text())["largest_forces"]
