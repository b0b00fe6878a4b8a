"""Random scenes with parameters and results for `gudgeon sensitivity`: a number of a table becomes that number times a parameter.

Free bodies are those of `random_friction` and `random_scenes`, with any law of friction; driven mechanisms are decks of inputs/
with other values of their own parameters.
"""

import dataclasses
import math
import re

import numpy as np
import random_friction
import random_scenes
from support import ROOT, changed, text_of

KINDS = ("pin", "socket", "bushing", "block", "disc", "together", "driven")
SI = {"mm": (1e-3, "m"), "rpm": (math.pi/30, "rad/s"), "rad/s": (1.0, "rad/s"), "GPa": (1e9, "Pa"), "kg": (1.0, "kg"),
      "cP": (1e-3, "Pa.s"), "": (1.0, "")}
ROWS = 20  # output times of a motion
LAWS = ("none", "coulomb", "smooth", "ambrosio", "rooney_deravi", "threlfall", "stribeck", "lugre", "dahl")
COLUMNS = {  # section: columns that a parameter may multiply
    "bodies": ("mass", "inertia", "ixx", "x", "y", "vx", "vy", "omega", "wx"),
    "points": ("xi", "eta"),
    "material": ("young",),
    "clearance": ("clearance", "bearing_radius", "radius", "gap", "length", "corner_radius"),
    "contact": ("restitution",),
    "friction": ("coefficient", "v0", "v1", "v_t", "stribeck_speed"),
}
DRIVEN = {  # deck: end of the motion, parameters of it with their ranges and units; none: numbers of its tables
    "sensitivity_slider_crank": ("3 ms", {"c": (0.2, 0.8, "mm"), "speed": (2000, 6000, "rpm"), "restitution": (0.7, 0.95, ""),
                                          "young": (100, 210, "GPa"), "rod": (0.1, 0.3, "kg")}),
    "slider_crank_6_6_bushing": ("2 ms", {"c": (0.2, 0.6, "mm"), "speed": (100, 200, "rad/s")}),
    "slider_crank_6_6_ball": ("2 ms", {"c": (0.2, 0.6, "mm"), "speed": (100, 200, "rad/s")}),
    "slider_crank_lubricated": ("4 ms", {"c": (0.1, 0.4, "mm"), "speed": (3000, 5000, "rpm"), "viscosity": (100, 500, "cP")}),
    "slider_crank_translational": ("3 ms", {"c": (0.2, 0.6, "mm"), "speed": (3000, 5000, "rpm")}),
    "hatch": ("400 ms", {}),
}


@dataclasses.dataclass(frozen=True)
class Scene:
    """A deck with a section [sensitivity]."""

    label: str
    text: str
    parameters: dict  # name: (value, unit), SI
    results: tuple  # as in the deck

    @property
    def kind(self):
        """What it is of."""
        return self.label.split()[0]


def tables(text):
    """Lines of the tables of a deck: section, names of columns with units, (number of the line, cells) of rows."""
    lines, found, k = text.splitlines(), [], 0
    while k < len(lines):
        head = re.match(r"\s*\[([\w.]+)\]", lines[k])
        k += 1
        if not head or k >= len(lines) or not re.match(r"\s*name(\s|$)", lines[k]):
            continue
        names, rows = lines[k].split("#")[0].split(), []
        k += 1
        while k < len(lines) and lines[k].strip() and not lines[k].lstrip().startswith("["):
            rows.append((k, re.findall(r'"[^"]*"|\{[^}]*\}|\S+', lines[k].split("#")[0])))
            k += 1
        found.append((head[1], names, rows))
    return lines, found


def names_of(text, top):
    """Names of the items of all tables of one kind."""
    return [cells[0] for section, _, rows in tables(text)[1] if section.split(".")[0] == top for _, cells in rows if cells]


def vary(rng, text, count):
    """The text with `count` numbers multiplied by parameters q1, q2, ... of the value 1, all rows of their column at once."""
    places = sorted(place for place in places_of(text) if place.split(".")[0] != "friction" or
                    place.split(".")[1] == re.search(r"(?m)^friction += +(\w+)|\Z", text)[1])
    chosen = [places[k] for k in rng.choice(len(places), min(count, len(places)), replace=False)]
    return multiplied(text, chosen), {f"q{n + 1}": (1.0, "") for n in range(len(chosen))}


def places_of(text):
    """Columns that a parameter may multiply, by section and name: (line, number of the cell) of their numbers, unit."""
    places = {}
    for section, names, rows in tables(text)[1]:
        for k, word in enumerate(names):
            name, _, unit = word.rstrip("]").partition("[")
            cells = [(line, k) for line, row in rows if len(row) > k and re.fullmatch(r"-?[\d.]+(e-?\d+)?", row[k]) and float(row[k])]
            if name in COLUMNS.get(section.split(".")[0], ()) and cells:
                places[f"{section}.{name}"] = (cells, " " + unit if unit else "")
    return places


def multiplied(text, chosen):
    """The text with these columns multiplied by parameters q1, q2, ... of the value 1."""
    lines, found = tables(text)
    rows, places = {line: cells for _, _, table in found for line, cells in table}, places_of(text)
    for n, place in enumerate(chosen):
        cells, unit = places[place]
        for line, k in cells:
            rows[line][k] = "{q%d*%s%s}" % (n + 1, rows[line][k], unit)
            lines[line] = " ".join(rows[line])
    text = "\n".join(lines) + "\n"
    declared = "".join(f"q{n + 1} = 1 # {place}\n" for n, place in enumerate(chosen))
    if "[parameters]" not in text:
        text = text.replace("[scene]\n", "[parameters]\n[scene]\n", 1)
    return re.sub(r"(?m)^\[parameters\].*\n", lambda head: head[0] + declared, text)


def results_of(rng, text, end):
    """Results of all kinds, of the first contacts of joints and of one body."""
    words = []
    for joint in names_of(text, "clearance"):
        words += [f"{joint}.onset(1..2)", f"{joint}.impact_speed(1..2)", f"{joint}.peak_force(1..2)", f"{joint}.peak_penetration(1)",
                  f"{joint}.duration(1)", f"{joint}.release_speed(1)"]
    body = str(rng.choice([name for name in names_of(text, "bodies") if name != "crank"]))  # whose centre is at rest
    early, late = (end*int(rng.integers(*limits))/ROWS for limits in ((2, 8), (10, ROWS)))
    words += [f"at({body}.velocity.x,{early!r}s)", f"at({body}.position.y,{late!r}s)", f"at({body}.velocity.y,{late!r}s)",
              f"max({body}.velocity.y)", f"min({body}.velocity.x)", "max(request.asked)"]
    request = f"[request]\nname value\nasked {{{body}.position.x*{body}.velocity.y}}\n"
    return words, request


def with_study(rng, text, end, parameters):
    """The text with its results asked for."""
    words, request = results_of(rng, text, end)
    text = changed(text, "output", every=f"{end/ROWS!r} s", channels="*.position *.velocity request.*", figures=None)
    return text + request + f"[sensitivity]\nparameters = {' '.join(parameters)}\nresults = {' '.join(words)}\n", tuple(words)


def draw(kind, seed):
    """Scene number `seed` of a kind."""
    rng = np.random.default_rng([seed, KINDS.index(kind), 49])
    if kind == "driven":
        return driven(rng, seed)
    if kind == "together":
        scene = random_scenes.draw(random_scenes.KINDS[seed % 4], seed)
        text, law, end = scene.text, "none", scene.end
    else:
        scene, law, end = random_friction.draw(kind, seed), LAWS[seed % len(LAWS)], random_friction.END
        text = re.sub(r"(?ms)^\[friction\.\w+\].*?(?=^\[)", "", scene.text) if law not in ("coulomb", "smooth") else scene.text
        if law == "none":
            text = text.replace("friction = coulomb\n", "friction = none\n").replace("{friction}", "none")
        else:
            text = text.replace("friction = coulomb", f"friction = {law}") + scene.tables.get(law, "")
    text, parameters = vary(rng, text, 2)
    text, results = with_study(rng, text, end, parameters)
    return Scene(f"{kind} {seed} {law}", text, parameters, results)


def driven(rng, seed):
    """A deck of inputs/ with random values of its parameters."""
    name = list(DRIVEN)[seed % len(DRIVEN)]
    end, ranges = DRIVEN[name]
    text = re.sub(r"(?ms)^\[(sensitivity|request|sweep|shapes)[\w.]*\].*?(?=^\[|\Z)", "", text_of(ROOT / "inputs" / f"{name}.deck"))
    text = changed(text, "analysis.dynamic", end=end, method="radau" if "lubricated" in name else None)
    parameters = {}
    for word, (low, high, unit) in ranges.items():
        value = float(f"{rng.uniform(low, high):.6g}")
        text = changed(text, "parameters", **{word: f"{value} {unit}".strip()})
        parameters[word] = (value, unit)
    if parameters:
        chosen = rng.choice(sorted(parameters), 2, replace=False)
        parameters = {str(word): (parameters[word][0]*SI[parameters[word][1]][0], SI[parameters[word][1]][1]) for word in chosen}
    else:
        text, parameters = vary(rng, text, 2)
    text, results = with_study(rng, text, float(end.split()[0])*1e-3, parameters)
    return Scene(f"driven {seed} {name}", text, parameters, results)
