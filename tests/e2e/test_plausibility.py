"""Values that are possible but unusual: notes in explain and in the summary, with the value and what is usual; none for usual decks."""

import json
import re

import pytest
from support import ROOT, call, scratch, written

DECK = """deck = 1
[scene]
gravity = 0 -9.81 m/s^2
[bodies]
name mass[kg] inertia[kg.m^2] x[m] angle[deg]
crank 1 2e-3 0.05 0
rod 1 8e-3 0.25 0
slider 0.5 1e-3 0.4 0
[points]
name body xi[m]
a ground 0
ca crank -0.05
cb crank 0.05
ra rod -0.15
rb rod 0.15
s slider 0
[material]
name young[GPa] poisson
steel 207 0.3
[contact.flores]
name restitution stiffness
law 0.9 0N/m^1.5
[lubricant]
name viscosity
oil 0.04Pa.s
[joint.revolute]
name i j
A a ca
B cb ra
[clearance.revolute]
name bearing journal bearing_radius[mm] clearance[mm] material law
pin rb s 10 0.05 steel law
[joint.translational]
name i j axis
rail a s x
[analysis.dynamic]
end = 1 ms
"""

UNUSUAL = {
    "gravity": ("-9.81 m/s^2", "-98.1 m/s^2", r"gravity is 98\.1 m/s\^2; usual: 9\.81"),
    "inertia": ("rod 1 8e-3", "rod 1 8000", r"body 'rod': .* radius of gyration of 89400 mm, 5\d\d times"),
    "tiny inertia": ("rod 1 8e-3", "rod 1 8e-9", r"body 'rod': .* radius of gyration of 0\.0894 mm"),
    "length": ("a ground 0\n", "a ground 0\nfar ground 150\n", r"point 'far' is 150 m from the origin of its body, \S+ times the median"),
    "mass": ("slider 0.5 1e-3", "slider 5e5 1e3", r"body 'slider' has a mass of 500000 kg, 500000 times the median"),
    "clearance": ("10 0.05 steel", "10 5 steel", r"joint 'pin': clearance over radius is 0\.5; usual: 0\.0001 to 0\.01"),
    "stiffness": ("0N/m^1.5", "1e5N/m^1.5", r"contact stiffness of law 'law' is 100000 N/m\^1\.5, \S+ times that of Hertz"),
    "viscosity": ("0.04Pa.s", "40Pa.s", r"lubricant 'oil' has a viscosity of 40 Pa\.s; usual: 0\.001"),
    "angle": ("rod 1 8e-3 0.25 0", "rod 1 8e-3 0.25 20", r"assembly rotated body 'rod' by \S+ deg"),
    "position": ("rod 1 8e-3 0.25 0", "rod 1 8e-3 0.35 0", r"assembly moved body '\w+' by \S+ mm, \S+ % of the size"),
}


def notes(gudgeon, text):
    """The notes of explain, and those of summary.json."""
    where = scratch()
    said = call(gudgeon, "explain", written(where, text)).stdout
    shown = re.search(r"unusual values.*\n((?:  .+\n)+)", said)
    call(gudgeon, "run", where / "scene.deck", "--out", where / "out", "--quiet", "--write", "numbers")
    listed = json.loads((where / "out/summary.json").read_text())["notes"]
    assert listed == ([line.strip() for line in shown[1].splitlines()] if shown else [])
    told = [line[6:] for line in (where / "out/summary.txt").read_text().splitlines() if line.startswith("note: ")]
    assert told == listed
    return listed


def test_usual_values(gudgeon):
    assert notes(gudgeon, DECK) == []


@pytest.mark.parametrize("name", UNUSUAL)
def test_unusual_value(gudgeon, name):
    """One slip, the note of it, and no other that it does not cause."""
    old, new, pattern = UNUSUAL[name]
    assert DECK.count(old) == 1
    found = notes(gudgeon, DECK.replace(old, new))
    assert any(re.search(pattern, note) for note in found), found
    assert len(found) <= (3 if name in ("angle", "position") else 1), found


@pytest.mark.parametrize("gravity", ["0 0", "0 -1.62", "3.71 0", "-6.94 -6.94"])
def test_known_gravity(gudgeon, gravity):
    """None, Moon, Mars, Earth along a diagonal."""
    assert notes(gudgeon, DECK.replace("0 -9.81 m/s^2", f"{gravity} m/s^2")) == []


def test_density(gudgeon):
    """A box in space of 1 kg and 1 cm^3."""
    text = (ROOT / "docs/reference/space.md").read_text()
    text = text[text.index("```deck bar.deck\n") + 17 : text.index("```", text.index("```deck bar.deck") + 3)].replace("figures    = bar.position\n", "")
    box = "[shapes]\nname body shape length[m] width[m] height[m]\nbox bar box 0.01 0.01 0.01\n"
    assert any("1e6 kg/m^3; usual: 1000" in note for note in notes(gudgeon, text + box))
    assert notes(gudgeon, text + box.replace("0.01 0.01 0.01", "0.01 1 0.0128")) == []
