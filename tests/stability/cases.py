"""The table of the hard cases: deck, what is measured, and for each way of solving it the limit that it must keep.

A way without a limit is shown only: it is known not to hold the case as well as the limits ask, and stands in the table to be
seen beside the others. Limits are never changed to make a way pass.
"""

import dataclasses
import pathlib
import re
import sys
from typing import Callable, Optional

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tests" / "e2e"))
import contact_measures as contact  # noqa: E402
from film_cases import film_cases  # noqa: E402
import references as ref  # noqa: E402
from space_cases import space_cases  # noqa: E402
from support import changed  # noqa: E402

HARD = "inputs/hard"
HOLDS = ("none", "baumgarte alpha=5s^-1 beta=5s^-1", "baumgarte alpha=20s^-1 beta=20s^-1", "baumgarte_adaptive", "partitioning",
         "augmented_lagrangian", "projection")
FIXED_STEP_HOLDS = (*HOLDS, "baumgarte_step")  # its gains follow the step, which must then be given
SOLVERS = ("lapack", "complete", "schur", "sparse", "augmented_lagrangian")
METHODS = ("adams", "bdf", "ida")


@dataclasses.dataclass(frozen=True)
class Way:
    """How a case is solved, and the limits of its error and of its constraint violation (None: shown only)."""

    tolerance: str = ""  # the deck's
    stabilise: str = "auto"
    solver: str = "auto"
    method: str = "verner"
    step: str = ""  # fixed steps
    limit: Optional[float] = None
    violation: Optional[float] = None
    is_fast: bool = False  # also a test of `make test`

    @property
    def is_required(self):
        """Whether falling short is a failure."""
        return self.limit is not None or self.violation is not None

    @property
    def label(self):
        """Integrator, way of holding the constraints, solver."""
        hold = re.sub(r" alpha=(\S+?)s\^-1 beta=(\S+?)s\^-1", r" \1/\2", self.stabilise)
        return f"{self.method} {hold} {self.solver}"


@dataclasses.dataclass(frozen=True)
class Case:
    """A hard case: its deck, its error as a number, and the ways it is solved."""

    name: str
    deck: str
    measure: Callable  # of a finished run, or of the message of one that must end early
    what: str  # the error measured, with its unit
    ways: tuple
    ends_early: bool = False  # must end with exit code 4 or 5
    says: tuple = ()  # texts that the run must print
    settings: tuple = ()  # (section, key, value) beside those of the way; value None: taken out

    def text(self, way):
        """The deck with the way's settings, and without figures."""
        text = (ROOT / self.deck).read_text()
        settings = {"method": way.method, "stabilise": way.stabilise, "solver": way.solver}
        if (way.stabilise, way.solver) != ("auto", "auto"):
            settings["coordinates"] = "full"  # a way of holding or solving needs constraints
        if way.tolerance:
            settings["tolerance"] = way.tolerance
        if way.step:
            settings["step"] = way.step
        text = changed(changed(text, "analysis.dynamic", **settings), "output", figures=None)
        for section, key, value in self.settings:
            if key != "step" or not way.step:
                text = changed(text, section, **{key: value})
        return text


# ---- what is measured ---------------------------------------------------------------------------------------------------


def at(run, times):
    """Places of the times among the output instants."""
    places = [int(np.argmin(np.abs(run.time - t))) for t in times]
    assert np.allclose(run.time[places], times, rtol=0.0, atol=1e-12), "an instant is missing"
    return places


def bob_at_end(run):
    """A01: distance from the exact place of the bob."""
    angle = ref.swing(run.time[-1], np.sqrt(ref.G), 0.5*np.pi)
    return float(np.linalg.norm(run.item("bodies/position", "bob")[-1] - (np.sin(angle), -np.cos(angle))))


def first_joint_of(n):
    """A02 with n four-bars: distance of B0, the end of rod_0, from its exact place at the end."""
    def measure(run):
        theta = ref.four_bars_angle(n, float(run.time[-1]))
        middle = run.item("bodies/position", "rod_0")[-1]
        angle = run.item("bodies/angle", "rod_0")[-1]
        tip = middle + 0.5*np.array([np.cos(angle), np.sin(angle)])
        return float(np.linalg.norm(tip - (np.sin(theta), np.cos(theta))))

    return measure


def squeezer_angles(run):
    """A03: greatest error of the seven angles."""
    k1, k2, k3, k4, k5, k6, k7 = (run.item("bodies/angle", f"K{i}")[-1] for i in range(1, 8))
    found = np.array([k1, k2 - k1, k3, k4 - k5, k5, k6 - k7, k7])
    return float(np.max(np.abs(found - ref.SQUEEZER_ANGLES)))


def four_bar_angles(run):
    """Greatest error of crank, coupler and rocker angle at the instants of the table."""
    table = np.array(ref.FOUR_BAR_ANGLES)
    places = at(run, table[:, 0])
    found = np.column_stack([run.item("bodies/angle", name)[places] for name in ("crank", "coupler", "rocker")])
    return float(np.max(np.abs(found - table[:, 1:])))


def violation_growth(run):
    """Greatest violation of the second half by that of the first."""
    violation = run.item("joints/violation", "crankpin")
    half = len(violation)//2
    return float(np.max(violation[half:])/np.max(violation[:half]))


def violation_decay(run):
    """Its inverse: small if the violation grows."""
    return 1.0/violation_growth(run)


def parallel_angles(run):
    """The parallelogram: greatest error of crank and rocker at the end; both turn at 10 rad/s for ever."""
    exact = np.pi/3 + 10.0*run.time[-1]
    return float(max(abs(run.item("bodies/angle", name)[-1] - exact) for name in ("crank", "rocker")))


def h_frame_motion(run):
    """The H-frame: greatest error of the beam's place and acceleration over the run, of its greatest values."""
    mass, force, w = 3.2, 8.0, 3.0
    t = run.time
    place = force/(mass*w*w)*(1.0 - np.cos(w*t))
    acceleration = force/mass*np.cos(w*t)
    error = np.abs(run.item("bodies/position", "beam")[:, 0] - place).max()/place.max()
    return float(max(error, np.abs(run.item("bodies/acceleration", "beam")[:, 0] - acceleration).max()*mass/force))


HANGING = -0.5*np.pi  # angle of a bar that hangs down


def pendulum_motion(body, omega, start):
    """Greatest error of a bar's angle over the run against a pendulum released at `start` from the downward vertical."""
    def measure(run):
        exact = ref.swing(run.time, omega, start)
        return float(np.max(np.abs(run.item("bodies/angle", body) - HANGING - exact)))

    return measure


def pendulum_acceleration(body, omega):
    """Greatest error of its angular acceleration, by omega^2, against -omega^2 sin(angle) at its own angle: the twin without
    the redundant joints has this acceleration."""
    def measure(run):
        exact = -omega**2*np.sin(run.item("bodies/angle", body) - HANGING)
        return float(np.max(np.abs(run.item("bodies/angular_acceleration", body) - exact))/omega**2)

    return measure


def spring_pendulum_motion(run):
    """Stiff spring pendulum: greatest distance of the bob from its place by an independent integration."""
    x, y = ref.spring_pendulum(1.0, 1.0e6, 100.0, 1.0, 1.0, run.time[1:])
    return float(np.max(np.hypot(*(run.item("bodies/position", "bob")[1:] - np.column_stack([x, y])).T)))


def crank_angle(coupler_mass):
    """Crank-rocker of light_coupler.deck: error of crank, coupler and rocker angle at the end."""
    lengths = (0.1, np.hypot(0.28, 0.22), np.hypot(0.06, 0.30))
    masses = (1.0, coupler_mass, 1.0)
    inertias = tuple(m*length**2/12 for m, length in zip(masses, lengths))

    def measure(run):
        bar = ref.FourBar(0.4, lengths, masses, inertias, gravity=ref.G)
        angle = bar.motion(np.arctan2(0.08, 0.06), 6.0, run.time[-1])[-1, 0]
        exact = np.array([angle, *bar.angles(angle)])
        found = np.array([run.item("bodies/angle", name)[-1] for name in ("crank", "coupler", "rocker")])
        return float(np.max(np.abs(np.angle(np.exp(1j*(found - exact))))))

    return measure


def dead_point_time(message):
    """The driver at its dead centre: error of the time that the message says."""
    found = re.search(r"at t = (\S+) s", message)
    return abs(float(found.group(1)) - np.arccos(3/8)) if found else np.inf


# ---- the table ----------------------------------------------------------------------------------------------------------


def others(tolerance, holds=HOLDS, solvers=SOLVERS, methods=METHODS):
    """The other ways beside the default one, shown only."""
    return (tuple(Way(tolerance, stabilise=hold) for hold in holds)
            + tuple(Way(tolerance, solver=solver) for solver in solvers)
            + tuple(Way(tolerance, method=method) for method in methods))


def must(limit, *tolerances, fast=None, **way):
    """The default way at the tolerances, with a limit; `fast` is the tolerance that is also a test."""
    return tuple(Way(tolerance, limit=limit, is_fast=tolerance == fast, **way) for tolerance in tolerances)


def four_bars(n, fast=None, more=()):
    """A02 with n four-bars."""
    return Case(f"A02 N = {n}", f"{HARD}/a02_four_bars_{n}.deck", first_joint_of(n), "B0 at 10 s [m]",
                must(1e-6, "1e-6", "1e-7", "1e-8", "1e-9", fast=fast) + more)


THREE_PINS_OMEGA = np.sqrt(ref.G*(0.5 + 2.0*0.7)/(1.0/3.0 + 2.0*(0.49 + 0.16/12)))
EXTRA_BAR_OMEGA = np.sqrt(ref.G/0.2*(1.5*1.0 + 2.0)/(1.0 + 2.0))
ROD_OMEGA = np.sqrt(1.5*ref.G)

VARIABLE_STEPS = ("analysis.dynamic", "step", None)
FOUR_BAR = "inputs/four_bar.deck"


def each_solver(limit):
    """All solvers at 1e-10, the default one also a test."""
    return must(limit, "1e-10", fast="1e-10") + tuple(Way("1e-10", solver=solver, limit=limit) for solver in SOLVERS)


def redundant(name, deck, body, omega, start, report):
    """Motion and accelerations of a pendulum whose deck has redundant joints, and what must be said of them."""
    path = f"{HARD}/{deck}.deck"
    return (
        Case(name, path, pendulum_motion(body, omega, start), "angle in 5 s [rad]", each_solver(1e-7), says=(report,)),
        Case(f"{name}, twin", path, pendulum_acceleration(body, omega), "acceleration, relative", each_solver(1e-9)),
    )


BALL = f"{HARD}/dropped_ball.deck"
BODIES = f"{HARD}/two_free_bodies.deck"
PIN = f"{HARD}/pin_at_rest.deck"
QUIET = ("output", "every", "10 ms")


def with_parameters(**values):
    """Settings of a deck's parameters."""
    return tuple(("parameters", key, value) for key, value in values.items())


def impact_of(name, restitution, fast=None, pin_mass=1.0, delivers=None, **parameters):
    """Two free bodies: what the law delivers, the restitution unless said otherwise, and momentum."""
    return Case(name, BODIES, contact.delivered(delivers or restitution, pin_mass), "restitution and momentum, relative",
                must(1e-8, "1e-10", fast=fast),
                settings=with_parameters(restitution=restitution, pin_mass=f"{pin_mass} kg", **parameters))


def elastic(name, deck, **parameters):
    """Elastic bounces: each changes the energy by less than ten times the tolerance, either way."""
    return Case(name, deck, contact.energy_per_bounce, "energy per bounce, relative",
                tuple(Way(tolerance, limit=10.0*float(tolerance), is_fast=tolerance == "1e-8")
                      for tolerance in ("1e-6", "1e-8", "1e-10")), settings=with_parameters(**parameters))


def bounded(steps, end):
    """No more than so many steps until the end: the run fails beyond."""
    return (("analysis.dynamic", "maximum_steps", str(steps)), ("analysis.dynamic", "end", end))


TINY = with_parameters(c="1 um") + (("output", "channels", "slider.position energy.*"),)
CONTACTS = (
    impact_of("impact, ce = 0.1", 0.1, fast="1e-10"),
    impact_of("heavy pin", 0.5, pin_mass=1.0e4, fast="1e-10"),
    impact_of("light pin", 0.5, pin_mass=1.0e-4, fast="1e-10"),
    impact_of("Kelvin-Voigt", 0.5, law="kelvin_voigt", fast="1e-10"),
    impact_of("Kelvin-Voigt, book", 0.5, law="kelvin_voigt", form="book", delivers=np.sqrt(0.5), fast="1e-10"),
    elastic("elastic pin", BODIES, law="hertz"),
    elastic("elastic ball", BALL),
    elastic("elastic ball, fast", BALL, height="1 m"),
    elastic("exact, ce = 1", BODIES, restitution="1"),
    Case("10,000 bounces", BALL, contact.energy_of_10000_bounces, "energy of all bounces, relative", must(1e-4, "1e-10"),
         settings=(("analysis.dynamic", "end", "660 s"), ("output", "every", "1 s"))),
    Case("pin at rest", PIN, contact.at_rest(contact.PIN_REST), "depth, relative", must(1e-6, "1e-8", fast="1e-8"),
         settings=bounded(60000, "100 s") + (QUIET,)),
    Case("pin at rest, jump", PIN, contact.at_rest(2.0*ref.G/(0.5*1e7*(1.0 + 0.3**2))), "depth, relative",
         must(1e-6, "1e-8", fast="1e-8"), settings=with_parameters(law="kelvin_voigt") + bounded(60000, "100 s") + (QUIET,)),
    Case("ball at rest", BALL, contact.at_rest(contact.BALL_REST), "depth, relative", must(1e-6, "1e-8", fast="1e-8"),
         settings=with_parameters(law="exact") + bounded(60000, "100 s") + (QUIET,)),
    Case("bounces that die out", BALL, contact.zeno_times(0.5), "onsets, of the time of all bounces",
         must(1e-2, "1e-8", fast="1e-8"), settings=with_parameters(law="exact", height="1 m") + bounded(6000, "4 s")),
    Case("overlap at the start", BALL, contact.overlap_told("floor", 2e-6), "depth in the message, relative",
         must(1e-6, "1e-8", fast="1e-8"), ends_early=True, settings=with_parameters(height="-2 um")),
    Case("preloaded", BALL, contact.at_rest(contact.BALL_REST), "depth, relative", must(1e-6, "1e-8", fast="1e-8"),
         settings=with_parameters(law="exact", height=f"{-contact.BALL_REST} m") + (("analysis.dynamic", "overlap", "preload"),)),
    Case("both faces at once", f"{HARD}/wedged_slider.deck", contact.wedge_angle, "angle beyond touch, relative",
         must(1e-6, "1e-8", fast="1e-8"), settings=bounded(3000, "0.2 s")),
    Case("clearance 1 um", "inputs/slider_crank_dry.deck", contact.distance_from_ideal, "slider off its ideal place [um]",
         must(5.0, "1e-8", fast="1e-8"), settings=TINY + bounded(20000, "24 ms")),
    Case("clearance 1 um, ledger", "inputs/slider_crank_dry.deck", contact.ledger, "residual, relative", must(1e-6, "1e-8"),
         settings=TINY),
    Case("grazed by 1 nm", f"{HARD}/grazed_plane.deck", contact.grazed(1e-9), "impact speed, relative",
         must(1e-6, "1e-10", fast="1e-10")),
    Case("missed by 1 nm", f"{HARD}/grazed_plane.deck", contact.grazed(-1e-9), "contacts", must(0.0, "1e-10", fast="1e-10"),
         settings=with_parameters(overlap="-1 nm")),
    Case("two contacts at once", f"{HARD}/two_contacts.deck", contact.both_at_once, "durations, peaks, turning, relative",
         must(1e-8, "1e-10", fast="1e-10")),
)
CASES = (
    Case("A01 pendulum", f"{HARD}/a01_simple_pendulum.deck", bob_at_end, "bob at 10 s [m]",
         must(1e-8, "1e-10", fast="1e-10") + (Way("1e-6"), Way("1e-8"), Way("", method="rk4", step="1 ms")) + others("1e-10")),
    four_bars(1),
    four_bars(2, fast="1e-6", more=(Way("1e-8", method="rk4", step="1 ms"), *others("1e-8"))),
    four_bars(10, fast="1e-8"),
    four_bars(40, fast="1e-6", more=(Way("1e-8", solver="sparse"), Way("1e-8", solver="schur"))),
    Case("A03 squeezer", f"{HARD}/a03_andrews_squeezer.deck", squeezer_angles, "seven angles at 0.03 s [rad]",
         must(1e-8, "1e-11", fast="1e-11") + (Way("1e-8"), Way("", method="rk4", step="2 us")) + others("1e-11")),
    Case("four-bar", FOUR_BAR, four_bar_angles, "angles at 0.1 to 5 s [rad]",
         (Way("5e-13", stabilise="projection", limit=1e-6, violation=1e-12),
          Way("5e-14", stabilise="projection", limit=1e-7, violation=1e-12),
          Way("1e-12", stabilise="partitioning", violation=1e-12),
          *(Way("1e-12", stabilise=hold) for hold in HOLDS if hold not in ("projection", "partitioning")),
          *(Way("", stabilise=hold, step="0.1 ms") for hold in FIXED_STEP_HOLDS)),
         settings=(VARIABLE_STEPS,)),
    Case("four-bar, DIM grows", FOUR_BAR, violation_decay, "first half by second",
         (Way("", stabilise="none", step="0.1 ms", limit=0.7),)),
    Case("four-bar, 5/5 holds", FOUR_BAR, violation_growth, "second half by first",
         (Way("", stabilise="baumgarte alpha=5s^-1 beta=5s^-1", step="0.1 ms", limit=1.5),)),
    Case("parallelogram", f"{HARD}/parallelogram.deck", parallel_angles, "angles at 5 s [rad]",
         must(1e-6, "1e-8", "1e-10", fast="1e-8") + (Way("1e-6"), *others("1e-8"))),
    Case("H-frame", f"{HARD}/h_frame.deck", h_frame_motion, "place and acceleration, relative", each_solver(1e-9),
         says=("redundant.*'upper'",)),
    *redundant("extra bar", "overdetermined_four_bar", "bar_1", EXTRA_BAR_OMEGA, np.pi/3, "redundant.*'top_2'"),
    *redundant("pin given twice", "duplicated_joints", "rod", ROD_OMEGA, 0.5*np.pi, "redundant.*'again'"),
    *redundant("three pins", "three_pins", "rod", THREE_PINS_OMEGA, 0.5*np.pi, "redundant.*'second'"),
    Case("stiff spring", f"{HARD}/stiff_spring_pendulum.deck", spring_pendulum_motion, "bob in 5 s [m]",
         must(1e-6, "1e-9", fast="1e-9") + tuple(Way("1e-9", method=method) for method in METHODS)),
    Case("light coupler", f"{HARD}/light_coupler.deck", crank_angle(1.0e-6), "angles at 2 s [rad]",
         must(1e-6, "1e-11", fast="1e-11") + others("1e-11")),
    Case("wrong velocities", f"{HARD}/wrong_velocities.deck", crank_angle(1.0), "angles at 2 s [rad]",
         must(1e-6, "1e-11", fast="1e-11"), says=("velocity",)),
    Case("dead centre", f"{HARD}/dead_point.deck", dead_point_time, "time in the message [s]",
         must(1e-3, "1e-8", fast="1e-8") + tuple(Way("1e-8", stabilise=hold) for hold in HOLDS),
         ends_early=True, says=("top|crankpin|pivot|motor|main", "dead centre|try")),
    *CONTACTS,
    *film_cases(Case, Way, with_parameters),
    *space_cases(Case, Way, HOLDS, SOLVERS, with_parameters),
)
