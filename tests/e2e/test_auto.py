"""`method = auto`: the explicit method to the bit where nothing is stiff, radau where it is, told in the summary; named methods that are too slow."""

import h5py
import numpy as np
import pytest
from support import ROOT, assert_close, call, changed, finished, run_with, written

# two jaws press a plate of 0.1 kg with 20 N each; the friction is regularised at a speed so low that the plate creeps as if in tar
GRIP = """deck = 1
[scene]
title = "A plate in a grip"
gravity = 0 -9.81 m/s^2
[bodies]
name mass[kg] inertia[kg.m^2] x[m] y[m]
plate 0.1 1e-4 0 0
left 0.2 1e-4 -0.02 0
right 0.2 1e-4 0.02 0
[points]
name body xi[m] eta[m]
o ground 0 0
pl plate -0.01 0
pr plate 0.01 0
cl left 0 0
cr right 0 0
[joint.translational]
name i j axis
jl o cl x
jr o cr x
[joint.parallel]
name i j
level ground plate
[material]
name young[GPa] poisson density[kg/m^3]
steel 207 0.3 7850
[contact.hunt_crossley]
name stiffness[N/m^1.5] restitution
hz 1e8 0.3
[friction.ambrosio]
name coefficient v0[m/s] v1[m/s]
am 0.5 1e-5 1e-4
[clearance.plane]
name plane ball axis axis_angle[deg] radius[m] material law friction
fl pl cl x 180 0.01 steel hz am
fr pr cr x 0 0.01 steel hz am
[force.point]
name point fx
sl cl 20N
sr cr -20N
[analysis.dynamic]
end = 20 s
tolerance = 1e-8
method = auto
[output]
every = 100 ms
channels = plate.position.y plate.velocity.y fl.normal_force
"""


def numbers(path):
    """All numbers of run.h5 but those that tell of the program and the run."""
    found = {}
    with h5py.File(path / "run.h5") as file:
        file.visititems(lambda name, node: found.update({name: node[()]}) if isinstance(node, h5py.Dataset) and node.dtype.kind == "f" else None)
    return found


def test_grip(gudgeon):
    """8.6 million steps by verner; the motion is that of radau at a tighter tolerance."""
    run = run_with(gudgeon, GRIP)
    assert run.summary["steps"] < 3000 and run.summary["rhs_evaluations"] < 60000
    assert "verner, and radau in" in run.summary["method"] and "h lambda" in run.summary["method"]
    reference = run_with(gudgeon, GRIP.replace("method = auto", "method = radau").replace("1e-8", "1e-10"))
    for name in ("bodies/position", "bodies/velocity"):
        ours, theirs = (one.read(name)[:, 0] for one in (run, reference))
        assert_close(ours, theirs, absolute=1e-5 * np.abs(theirs).max(), what=name)


@pytest.mark.parametrize("tolerance, method", [("1e-8", "verner"), ("1e-9", "dop853")])
def test_to_the_bit(gudgeon, tmp_path, tolerance, method):
    """The dry slider-crank is not stiff."""
    deck = ROOT / "inputs" / "slider_crank_dry.deck"
    for name in ("auto", method):
        call(gudgeon, "run", deck, "--method", name, "--tolerance", tolerance, "--out", tmp_path / name, "--quiet")
    ours, theirs = numbers(tmp_path / "auto"), numbers(tmp_path / method)
    assert ours.keys() == theirs.keys() and len(ours) > 10
    for name in ours:
        assert np.array_equal(ours[name], theirs[name], equal_nan=True), name


def test_restart(gudgeon, tmp_path):
    """Saved and taken back within the stiff stretch: the same bits."""
    deck = written(tmp_path, changed(GRIP, "analysis.dynamic", checkpoint="1.5 s", end="5 s"))
    done = call(gudgeon, "run", deck, "--out", tmp_path / "out", "--verify-restart")
    assert "equal bit for bit after" in done.stdout


def test_explained(gudgeon, tmp_path):
    """`explain` tells what there is to choose from."""
    deck = written(tmp_path, GRIP)
    assert "explicit of order 6 (verner" in call(gudgeon, "explain", deck).stdout
    assert "explicit of order 8 (dop853" in call(gudgeon, "explain", deck, "--tolerance", "1e-9").stdout


def test_named_method_that_is_too_slow(gudgeon):
    """A film by verner: the warning says once by how much radau is better, and it is; the same by auto has none."""
    text = (ROOT / "inputs" / "journal_bearing.deck").read_text()
    runs = {name: run_with(gudgeon, text, method=name) for name in ("verner", "radau", "auto")}
    told = [words for words in runs["verner"].summary["warnings"] if words.startswith("stiff for method = verner")]
    assert len(told) == 1 and "radau" in told[0]
    assert not any("stiff for" in words for name in ("radau", "auto") for words in runs[name].summary["warnings"])
    assert runs["auto"].summary["rhs_evaluations"] < 3 * runs["radau"].summary["rhs_evaluations"]
