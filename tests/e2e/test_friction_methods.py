"""Friction that remembers, sticking and with bristles, by every method: the multistep ones and `ida` against verner."""

import numpy as np
import pytest
from support import ROOT, Run, assert_close, call, changed, scratch, written

COULOMB = "[friction.coulomb]\nname coefficient static_coefficient\ncoulomb 0.05 0.06\n\n"
LUGRE = "[friction.lugre]\nname coefficient static_coefficient stribeck_speed[m/s]\nlugre 0.05 0.06 0.01\n\n"
DAHL = "[friction.dahl]\nname coefficient\ndahl 0.05\n\n"


def shoe(law):
    """A shoe pulled to and fro over a plane: it sticks and slips."""
    return (ROOT / "inputs/friction.deck").read_text(), [f"friction={law}"]


def rolling(law):
    """A disc that rolls down an incline: its contact moves and sticks."""
    return changed((ROOT / "inputs/incline.deck").read_text(), "analysis.dynamic", end="0.2 s"), [f"friction={law}"]


def impacts(law):
    """A slider that meets its guide with two corners at once, again and again, in a mechanism with constraints."""
    text = (ROOT / "inputs/slider_crank_translational.deck").read_text()
    text = text.replace("{faces}   ambrosio", "{faces}   " + law)
    text = text.replace("[friction.ambrosio]", COULOMB + LUGRE + DAHL + "[friction.ambrosio]")
    return changed(text, "analysis.dynamic", end="2.4 ms", stabilise=None), []


def by_method(program, scene, law, method):
    """A run of a scene with one law by one method."""
    text, parameters = scene(law)
    text = changed(text, "output", figures=None, channels=None)
    directory = scratch()
    options = [word for parameter in parameters for word in ("--set", parameter)]
    call(program, "run", written(directory, text), "--out", directory / "out", "--quiet", "--method", method, "--tolerance", "1e-10",
         *options)
    return Run(directory / "out")


def rows(run):
    """Kind, contact and time of what contacts do."""
    names, table = run.table("events.dat")
    place = {name.strip(): k for k, name in enumerate(names)}
    return [(row[place["kind"]], row[place["contact"]], float(row[place["time"]])) for row in table]


@pytest.mark.parametrize("method", ["bdf", "ida"])
@pytest.mark.parametrize("law", ["coulomb", "lugre", "dahl"])
@pytest.mark.parametrize("scene", [shoe, rolling, impacts])
def test_as_by_verner(gudgeon, scene, law, method):
    """The same events at the same times, the same forces and motions; the ledger closes."""
    one, other = (by_method(gudgeon, scene, law, name) for name in ("verner", method))
    expected, found = rows(one), rows(other)
    assert [row[:2] for row in found] == [row[:2] for row in expected]
    assert len(expected) >= (5 if scene is not rolling and law == "coulomb" else 1)
    assert_close([row[2] for row in found], [row[2] for row in expected], absolute=1e-8, what="times of events")
    for path in ("bodies/position", "bodies/velocity", "clearances/contacts/friction_force"):
        found, expected = other.read(path), one.read(path)
        assert_close(found, expected, absolute=1e-5 * np.abs(expected).max(), what=path)
    assert np.abs(one.read("clearances/contacts/friction_force")).max() > 0.1
    for run in (one, other):
        assert run.summary["energy_residual_relative"] < 1e-7
