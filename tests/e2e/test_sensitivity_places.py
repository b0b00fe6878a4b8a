"""Derivatives where round-off is large against penetrations, at extremes anywhere in a step, and of a scene that is elsewhere."""

import json
import math
import sys

import pytest
from support import ROOT, assert_close, call, changed, scratch, written
from test_turned_decks import turned

sys.path.insert(0, str(ROOT / "tests" / "stability"))
import random_friction  # noqa: E402
import random_scenes  # noqa: E402
from sensitivity_scenes import Scene, multiplied  # noqa: E402
from sensitivity_survey import reference_of  # noqa: E402

OSCILLATORS = 12


def study_of(program, text, *options):
    """Derivatives of a study."""
    directory = scratch()
    call(program, "sensitivity", written(directory, text), "--out", directory / "out", "--quiet", *options)
    return json.loads((directory / "out/summary.json").read_text())["sensitivity"]


def oscillators():
    """Masses on springs, each from rest at its own place: x = A cos(w t), the velocity at least -A w."""
    rows = range(OSCILLATORS)
    lines = ["deck = 1", "[scene]", "gravity = 0 0 m/s^2", "[parameters]", "k = 1", "a = 1"]
    lines += ["[bodies]", "name mass[kg] inertia[kg.m^2] x"]
    lines += [f"b{n} {1 + 0.13*n} 0.1 {{a*{0.1 + 0.01*n} m}}" for n in rows]
    lines += ["[points]", "name body", "o ground", *[f"c{n} b{n}" for n in rows], "[force.spring]", "name i j stiffness"]
    lines += [f"s{n} o c{n} {{k*{100 + 37*n} N/m}}" for n in rows]
    lines += ["[analysis.dynamic]", "start = given", "end = 0.25 s", "[output]", "every = 0.25 s"]
    lines += ["[sensitivity]", "parameters = k a"]
    return "\n".join(lines) + "\nresults = " + " ".join(f"min(b{n}.velocity.x)" for n in rows) + "\n"


def test_extremes_anywhere_in_a_step(gudgeon):
    """The least velocity -A w by the stiffness and by the amplitude, wherever in a step it is: closed form."""
    derivatives = study_of(gudgeon, oscillators(), "--tolerance", "1e-11")
    for n in range(OSCILLATORS):
        speed = (0.1 + 0.01*n)*math.sqrt((100 + 37*n)/(1 + 0.13*n))
        of = derivatives[f"min(b{n}.velocity.x)"]
        for name, right in (("a", -speed), ("k", -0.5*speed)):
            assert_close(of[name]["value"], right, relative=2e-8, what=f"b{n} by {name}")


def test_penetrations_small_against_the_place(gudgeon):
    """Two pins three metres from the origin, penetrations of a micrometre: within stated errors of differences of runs."""
    text = multiplied(random_scenes.draw("bar_2", 1).text, ["bodies.mass"])
    words = ["pin0.peak_force(1)", "pin0.peak_penetration(1)", "pin1.peak_penetration(1)"]
    text = changed(text, "output", channels="p.position")
    derivatives = study_of(gudgeon, text + "[sensitivity]\nparameters = q1\nresults = " + " ".join(words) + "\n")
    right, unsure = reference_of(gudgeon, Scene("pins", text, {"q1": (1.0, "")}, ()), "q1", words, scratch())
    for k, word in enumerate(words):
        of = derivatives[word]["q1"]
        assert right[k] > 100.0*unsure[k] and of["error"] < 1e-4*right[k], word
        assert_close(of["value"], right[k], absolute=3*of["error"] + 3*unsure[k], what=word)


@pytest.mark.parametrize("seed", (2, 5))
def test_elsewhere(gudgeon, seed):
    """A ball in a socket, the same turned and shifted in space: the same derivatives, within stated errors."""
    scene, directory = random_friction.draw("socket", seed), scratch()
    text = changed(scene.text.replace("{friction}", "none"), "analysis.dynamic", end="0.01 s")
    call(gudgeon, "run", written(directory, text), "--out", directory / "out", "--quiet", "--write", "numbers")
    echo = (directory / "out/deck.echo").read_text()
    words = [f"j0.{kind}(1)" for kind in ("onset", "impact_speed", "peak_force", "peak_penetration", "duration")]
    found = []
    for place in (echo, turned(echo)):
        deck = multiplied(place, ["bodies.mass", "clearance.spherical.clearance"])
        found.append(study_of(gudgeon, deck + "\n[sensitivity]\nparameters = q1 q2\nresults = " + " ".join(words) + "\n"))
    compared = 0
    for word in words:
        for name in ("q1", "q2"):
            one, other = (derivatives[word][name] for derivatives in found)
            if one["value"] is None or other["value"] is None:
                continue
            compared += 1
            assert_close(other["value"], one["value"], absolute=3*(one["error"] + other["error"]), what=f"{word} by {name}")
    assert compared > 5
