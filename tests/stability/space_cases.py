"""The hard cases of space: what is measured of each, and the rows of the table."""

import numpy as np
import references as ref
import space_references as space

HARD = "inputs/hard"


def body(run, quantity, name):
    """A quantity of a body (instants, components)."""
    return run.item(f"bodies/{quantity}", name)


def turned(parameters, vectors):
    """Vectors along a body's own axes in the world, by its Euler parameters (instants, 4)."""
    e, v = parameters[:, :1], parameters[:, 1:]
    twice = 2*np.cross(v, vectors)
    return vectors + e*twice + np.cross(v, twice)


def spread(values):
    """Greatest departure from the start."""
    return float(np.max(np.abs(values - values[0])))


def kept(moments, masses, gravity, parts):
    """Energy and, with `parts` of the momentum about the origin, momentum of bodies {name: moments}, from their states alone: the
    greatest departure from the start, of the greatest kinetic energy and of the greatest momentum."""
    def measure(run):
        kinetic, potential, momentum = 0.0, 0.0, 0.0
        for name, own in moments.items():
            mass = masses[name]
            place, speed, spin = (body(run, what, name) for what in ("position", "velocity", "spin"))
            kinetic = kinetic + 0.5*mass*np.sum(speed**2, axis=1) + 0.5*spin**2 @ np.array(own)
            potential = potential - mass*(place @ np.array(gravity))
            momentum = momentum + mass*np.cross(place, speed) + turned(body(run, "orientation", name), spin*np.array(own))
        error = spread(kinetic + potential)/np.max(kinetic)
        if parts:
            error = max(error, spread(momentum[:, parts])/np.max(np.abs(momentum)))
        return error

    return measure


BRICARD = {name: [0.084167]*axis + [1.6667e-3] + [0.084167]*(2 - axis)
           for axis, names in enumerate((("one", "four"), ("two", "five"), ("three",))) for name in names}
GIMBAL = {"outer": (0.02, 0.02, 0.04), "inner": (0.01, 0.02, 0.01), "rotor": (0.005, 0.01, 0.005)}


def spin_of_free_body(run):
    """The tumbling body: greatest error of its spin over the run [rad/s]."""
    return float(np.max(np.abs(body(run, "spin", "body") - space.tumbling_spin(run.time))))


def nutation(run):
    """The top that nutates: greatest error of its two angles over the run."""
    place = body(run, "position", "top")[1:]
    found = np.column_stack([np.arccos(place[:, 2]/0.5), np.unwrap(np.arctan2(place[:, 1], place[:, 0]))])
    return float(np.max(np.abs(found - space.top_angles(run.time[1:], 40.0))))


def precession(rate):
    """The steady top: greatest error of its place over the run, by its height [1]."""
    def measure(run):
        angle = rate*run.time
        exact = 0.5*np.column_stack([0.5*np.cos(angle), 0.5*np.sin(angle), np.full(len(angle), 0.5*np.sqrt(3.0))])
        return float(np.max(np.abs(body(run, "position", "top") - exact))/0.5)

    return measure


def door_motion(run):
    """The door: greatest error of its place over the run [m]."""
    angle = ref.swing(run.time, np.sqrt(20.0*0.5*ref.G*0.4/(0.9 + 20.0*0.16)), 0.5*np.pi)
    exact = np.column_stack([-0.4*np.cos(angle), 0.4*np.sin(angle), np.ones(len(angle))])
    return float(np.max(np.abs(body(run, "position", "door") - exact)))


def governor_motion(run):
    """A05: greatest error of the slider's height over the run [m]."""
    return float(np.max(np.abs(body(run, "position", "slider")[:, 2] - space.governor(10.0, len(run.time) - 1)[2])))


def slider_motion(run):
    """Spatial slider-crank: greatest error of the slider's place over the run [m]."""
    crank = space.SpatialSliderCrank()
    exact = crank.slider(crank.motion(30.0, run.time[1:])[:, 0])
    return float(np.max(np.abs(body(run, "position", "slider")[1:, 0] - exact)))


def space_cases(case, way, holds, solvers, with_parameters):
    """The rows: kinds of case and way, the ways of holding and of solving."""
    def ways(limit, tolerance):
        """The default way, also a test; all ways of holding, those that drift to ten times the limit; the multistep methods shown."""
        return (way(tolerance, limit=limit, is_fast=True),
                *(way(tolerance, stabilise=hold, limit=limit if hold in ("projection", "partitioning") else 10*limit) for hold in holds),
                *(way(tolerance, solver=solver, limit=limit) for solver in solvers),
                way(tolerance, method="dop853", limit=limit), *(way(tolerance, method=method) for method in ("adams", "bdf", "ida")))

    everything = ("output", "channels", None)
    steady = 0.49691529475267387  # slow precession of the steady top [rad/s]
    return (
        case("tumbling body, 5 s", f"{HARD}/tumbling_body.deck", spin_of_free_body, "spin [rad/s]",
             tuple(way(tolerance, method="dop853", limit=1e-9, is_fast=tolerance == "1e-13")
                   for tolerance in ("1e-12", "1e-13", "1e-14")) + tuple(way(tolerance) for tolerance in ("1e-12", "1e-13", "1e-14"))),
        case("tumbling body, 1000 s", f"{HARD}/tumbling_body.deck",
             kept({"body": (1, 2, 3)}, {"body": 1.0}, (0, 0, 0), [0, 1, 2]), "energy and momentum, relative",
             (way("1e-13", method="dop853", limit=1e-11, is_fast=True), way("1e-13", limit=1e-11), way("1e-13", method="adams")),
             settings=(("analysis.dynamic", "end", "1000 s"), ("output", "every", "1 s"), everything)),
        case("tumbling body, 1000 s, spin", f"{HARD}/tumbling_body.deck", spin_of_free_body, "spin [rad/s]",
             (way("1e-13", method="dop853"), way("1e-13")),
             settings=(("analysis.dynamic", "end", "1000 s"), ("output", "every", "1 s"))),
        case("top, nutating", f"{HARD}/heavy_top.deck", nutation, "two angles in 1 s [rad]", ways(1e-9, "1e-12")),
        case("top, steady", f"{HARD}/heavy_top.deck", precession(steady), "place in 10 s, relative", ways(1e-9, "1e-12"),
             settings=with_parameters(spin="200 rad/s", precession=f"{steady} rad/s") + (("analysis.dynamic", "end", "10 s"),)),
        case("door on three hinges", f"{HARD}/door_on_three_hinges.deck", door_motion, "place in 5 s [m]", ways(1e-7, "1e-10"),
             says=("redundant.*'second'",)),
        case("gimbal rings", f"{HARD}/gimbal.deck", kept(GIMBAL, {"outer": 1, "inner": 0.8, "rotor": 2}, (0, 0, 0), [2]),
             "energy and momentum, relative", ways(1e-8, "1e-10"), settings=(everything,)),
        case("A04 Bricard", f"{HARD}/a04_bricard.deck", kept(BRICARD, dict.fromkeys(BRICARD, 1.0), (0, -ref.G, 0), []),
             "energy, relative", ways(1e-7, "1e-10"), says=("redundant",), settings=(everything,)),
        case("A05 governor", f"{HARD}/a05_flyball.deck", governor_motion, "slider in 10 s [m]", ways(1e-6, "1e-9")),
        case("spatial slider-crank", f"{HARD}/spatial_slider_crank.deck", slider_motion, "slider in 2 s [m]", ways(1e-8, "1e-11")),
    )
