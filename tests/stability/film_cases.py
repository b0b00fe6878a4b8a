"""Lubricant films under stress: inputs/hard/stressed_bearing.deck, over kinds of films and methods.

Of each run: every number finite, the journal within its bearing, the energy ledger closed to the limit (residual over the
greatest energy in it), no more than so many evaluations; and `maximum_steps` of the deck ends a run whose steps go on shrinking. A film that
comes to its end says joint, time and eccentricity (exit code 5); one that hands over to dry contact rests on it.

Shown only: Butenschoen's film between rotation and squeeze, which bends. Explicit methods take the light loads only: the others are
stiff.
"""

import re

import h5py
import numpy as np

DECK = "inputs/hard/stressed_bearing.deck"
JOINT, EPS_MAX = "bearing", 0.99999
STEPS = 60000  # of a run, at most
EVALUATIONS = 400000  # of a run, at most
ARCS = {"eccentricity above 0.99": {"steady": "30kN"},
        "oil of 4 cP": {"viscosity": "4cP", "steady": "300N"},
        "start and stop": {"speed": "250rpm", "swing": "-250rpm", "start_y": "-0.198mm", "steady": "300N"},
        "turned back": {"speed": "0rpm", "swing": "500rpm", "steady": "300N"},
        "ruptures every half turn": {"steady": "0N", "turning": "300N"},
        "load reverses": {"steady": "0N", "reversing": "3000N"}}
LIGHT = {"start and stop, light": {"speed": "250rpm", "swing": "-250rpm", "start_y": "-0.19mm", "steady": "3N"},
         "turned back, light": {"speed": "0rpm", "swing": "500rpm", "steady": "3N"},
         "ruptures every half turn, light": {"steady": "0N", "turning": "3N"},
         "load reverses, light": {"steady": "0N", "reversing": "30N"}}
FILMS = ("finite", "short_exact", "long_exact", "pinkus_sternlicht", "short_sommerfeld", "short_gumbel", "long_gumbel")
CHANGING = {("short_gumbel", "start and stop"): 1e-4}  # limits of films that change their half on the wall
QUICK = {("finite", arc) for arc in ARCS} | {("pinkus_sternlicht", "turned back"), ("short_exact", "load reverses"),
                                             ("long_gumbel", "eccentricity above 0.99"), ("short_gumbel", "start and stop")}


def sound(run):
    """Residual of the ledger over the greatest energy in it; infinite if anything is not as it should be."""
    with h5py.File(run.directory / "run.h5") as file:
        for group in ("bodies", "clearances", "energy"):
            for name, values in file[group].items():
                if isinstance(values, h5py.Dataset) and values.dtype.kind == "f" and not np.isfinite(values[()]).all() \
                        and name not in ("film_pressure", "temperature_rise", "length", "clearance"):
                    return np.inf
        ratio = file["clearances/eccentricity_ratio"][:]
        energy = {name: np.abs(values[:]).max() for name, values in file["energy"].items()}
    if not ratio.max() < 1.0 or run.summary["rhs_evaluations"] > EVALUATIONS:
        return np.inf
    return float(run.summary["energy_residual_max"]/max(energy.values()))


def rests_on_contact(run):
    """Hybrid: force of film and contact at the end less the load, relative; the state must be contact."""
    force = run.item("clearances/force", JOINT)[-1]
    states = run.read("clearances/contacts/state").ravel()
    if states[-1] not in (1, 3) or 2 not in states:
        return np.inf
    return float(np.hypot(force[0], force[1] - 300.0)/300.0)


def end_of_film(message):
    """Eccentricity in the message of a film that ends, against eps_max; joint and time must be there too."""
    found = re.search(rf"film of joint '{JOINT}' .* reached its limit: the eccentricity is (\S+) times the clearance", message)
    time = re.search(r"at t = (\S+) s", message)
    return abs(float(found.group(1)) - EPS_MAX) if found and time else np.inf


def film_cases(case, way, with_parameters):
    """The cases, made of the classes of the table."""
    bounded = (("analysis.dynamic", "maximum_steps", str(STEPS)),)

    def of(name, film, parameters, ways):
        return case(f"{name}: {film}", DECK, sound, "residual of the ledger, relative", ways,
                    settings=with_parameters(film=film, **parameters) + bounded)

    def implicit(film, arc):
        return (way("1e-8", method="bdf", limit=CHANGING.get((film, arc), 1e-5), is_fast=(film, arc) in QUICK),
                way("1e-6", method="ida", limit=1e-3))

    found = [of(arc, film, parameters, implicit(film, arc)) for arc, parameters in ARCS.items() for film in FILMS]
    found += [of(arc, "grid", parameters, (way("1e-6", method="bdf", limit=1e-4), way("1e-6", method="ida", limit=1e-3)))
              for arc, parameters in ARCS.items()]
    found += [of(arc, film, parameters, (way("1e-8", method="verner", limit=1e-6, is_fast=film == "finite"),))
              for arc, parameters in LIGHT.items() for film in ("finite", "pinkus_sternlicht")]
    found.append(of("load reverses", "squeeze", ARCS["load reverses"], (way("1e-8", method="bdf", limit=1e-5, is_fast=True),)))
    found.append(of("ruptures every half turn", "butenschoen", ARCS["ruptures every half turn"], (way("1e-8", method="bdf"),)))
    found.append(case("film at its end", DECK, end_of_film, "eccentricity in the message",
                      tuple(way("1e-8", method=method, limit=1e-12, is_fast=method == "bdf") for method in ("bdf", "ida")),
                      ends_early=True, says=(f"joint '{JOINT}'", "at t = ", "eps_max"),
                      settings=with_parameters(film="squeeze", steady="300N") + bounded))
    found.append(case("film and contact", DECK, rests_on_contact, "force at rest, relative",
                      tuple(way("1e-8", method=method, limit=1e-6, is_fast=method == "bdf") for method in ("bdf", "ida")),
                      settings=with_parameters(film="squeeze", level="hybrid", steady="300N") + bounded))
    return tuple(found)
