"""The energy ledger, which needs no reference, and laws and solvers that must keep it closed."""

import shutil

import numpy as np
import pytest
from reference_values import INERTIA, MASS
from scipy.integrate import trapezoid
from support import DECK, ROOT, Run, assert_close, call, changed, finished, scratch, written

ALL = (("output", "channels", None),)
LOOSE = sorted(deck for deck in (ROOT / "inputs").glob("*.deck")
               if "[clearance." in deck.read_text() and "[analysis.dynamic]" in deck.read_text())
OFTEN = {"impact_pair": 8, "shaken_ball": 10}  # tens of impacts: each has an error of its own


def parts(run):
    """All quantities of the ledger, by name."""
    names = ("kinetic", "potential", "elastic", "drive_work", "load_work", "dissipated_contact",
             "dissipated_friction", "stabilisation_work", "residual")
    return {name: run.read(f"energy/{name}").reshape(len(run.time)) for name in names}


def error(run):
    """Greatest residual over greatest energy, from the time histories."""
    energy = parts(run)
    return np.abs(energy["residual"]).max() / (energy["kinetic"] + energy["potential"] + energy["elastic"]).max()


@pytest.fixture
def tight(gudgeon):
    """All channels at tolerance 1e-10."""
    return finished(gudgeon, "--tolerance", "1e-10", changes=ALL)


def test_ledger_is_closed(tight):
    """At tolerance 1e-10 the residual stays below 1e-8 of the greatest energy."""
    assert error(tight) < 1e-8
    summary = tight.summary
    assert summary["energy_residual_max"] < 1e-8 * summary["energy_max"]


def test_ledger_falls_with_the_tolerance(gudgeon, tight):
    """A tighter run has a smaller residual."""
    errors = [error(finished(gudgeon, "--tolerance", t, changes=ALL)) for t in ("1e-6", "1e-8")] + [error(tight)]
    assert errors[0] > errors[1] > errors[2], errors


def test_residual_is_what_does_not_add_up(tight):
    """Energy now = energy at the start + work put in - work lost + residual.

    So it is at the end, which is the end of a step; within a step the works are interpolated.
    """
    energy = parts(tight)
    stored = energy["kinetic"] + energy["potential"] + energy["elastic"]
    books = (stored - stored[0] - energy["drive_work"] - energy["load_work"] - energy["stabilisation_work"]
             + energy["dissipated_contact"] + energy["dissipated_friction"])
    scale = stored.max()
    assert_close(books[-1], energy["residual"][-1], absolute=1e-13 * scale, what="books at the end")
    assert_close(books, energy["residual"], absolute=5e-9 * scale, what="books")


def test_kinetic_energy_is_that_of_the_recorded_motion(tight):
    """Kinetic energy from recorded velocities."""
    total = sum(
        0.5 * MASS[body] * (tight.item("bodies/velocity", body) ** 2).sum(axis=-1)
        + 0.5 * INERTIA[body] * tight.item("bodies/angular_velocity", body) ** 2
        for body in MASS
    )
    assert_close(tight.read("energy/kinetic").reshape(-1), total, relative=1e-12, what="kinetic energy")


def test_drive_work_is_the_integral_of_the_power(tight):
    """Work of the motor is what moment times speed adds up to, between the samples as well as these tell."""
    power = tight.item("drivers/power", "motor")
    moment = tight.item("drivers/moment", "motor")
    assert_close(power, moment * 5000.0 * 2.0 * np.pi / 60.0, absolute=1e-9 * np.abs(power).max(), what="power")


def test_contact_losses_are_those_of_the_events(tight):
    """What the ledger lost in contacts is the sum over the events."""
    contacts = tight.contacts
    ended = np.isfinite(contacts["duration"])
    lost = tight.read("energy/dissipated_contact").reshape(-1)
    for k in range(10):
        end = contacts["time"][k] + contacts["duration"][k]
        after = np.searchsorted(tight.time, end)
        if after < len(lost) and (k + 1 == len(contacts) or tight.time[after] < contacts["time"][k + 1]):
            assert_close(lost[after], contacts["energy_lost"][: k + 1].sum(), relative=1e-9, what=f"after impact {k + 1}")
    assert ended[:10].all()
    assert np.all(np.diff(lost) >= -1e-12)


def test_without_ledger(gudgeon, tight):
    """`ledger = off` leaves the motion alone."""
    run = finished(gudgeon, "--tolerance", "1e-10", changes=(("analysis.dynamic", "ledger", "off"),))
    assert run.summary["status"] == "complete"
    assert run.summary["ledger"] is False
    for field in ("time", "impact_speed", "peak_force"):
        assert_close(run.contacts[field][:5], tight.contacts[field][:5], relative=1e-9, what=field)


def test_energies_that_are_not_kept_are_told_why(gudgeon):
    """A deck that asks for energies and keeps no ledger is told which key takes them away."""
    for key, value in (("channels", "energy.*"), ("figures", "energy.kinetic")):
        text = changed(DECK.read_text(), "output", figures=None, channels=None)
        text = changed(changed(text, "output", **{key: value}), "analysis.dynamic", ledger="off")
        assert "'ledger = on'" in call(gudgeon, "check", written(scratch(), text), expect=3).stderr, key


def test_solvers_agree(gudgeon):
    """LAPACK on the augmented matrix and the Schur complement give the same first five impacts."""
    runs = [
        finished(gudgeon, "--tolerance", "1e-10", changes=(("analysis.dynamic", "solver", word),))
        for word in ("lapack", "schur")
    ]
    assert [run.summary["solver"] for run in runs] == ["lapack", "schur"]
    for field in ("time", "impact_speed", "peak_force", "peak_penetration", "duration", "release_speed", "energy_lost"):
        assert_close(runs[0].contacts[field][:5], runs[1].contacts[field][:5], relative=1e-9, what=field)


@pytest.mark.parametrize("option", ["law=hertz", "friction=0.05", "c=0.1mm", "c=0.2 mm", "restitution=0.5", "speed=1000 rpm"])
def test_parameters_keep_it_closed(gudgeon, option):
    """Other laws and numbers from the command line: the run ends well and its ledger is closed."""
    run = finished(gudgeon, "--tolerance", "1e-10", "--set", option, changes=ALL)
    assert run.summary["status"] == "complete"
    assert error(run) < 1e-8
    energy = parts(run)
    assert len(run.contacts) > 3
    lost = energy["dissipated_contact"][-1]
    scale = energy["kinetic"].max()
    if option == "law=hertz":
        assert abs(lost) < 1e-12 * scale
    else:
        assert lost > 1e-6 * scale
    if option == "friction=0.05":
        assert energy["dissipated_friction"][-1] > 1e-6 * scale
    else:
        assert abs(energy["dissipated_friction"][-1]) < 1e-12 * scale


TIED = """deck = 1
[scene]
gravity = 0 0 m/s^2
[bodies]
name   mass[kg]  inertia[kg.m^2]  x[m]  y[m]
arm    1         0.01             0.2   0
block  1         0.01             0.6   0
[points]
name  body    xi[m]  eta[m]
o     ground  0      0
a     arm     -0.2   0
tip   arm     0.3    0
w     block   0      0
b0    ground  0.6    0
b1    block   0      1
b2    ground  1.6    1
[joint.revolute]
name   i   j
pin    o   a
pivot  b0  w
[joint.distance]
name  i   j
link  b1  b2
[driver.speed]
name  joint  speed
mot   pin    20rad/s
[force.spring]
name  i  j    stiffness[N/m]  free_length[m]  damping[N.s/m]
sp    w  tip  1000            0.1             5
[analysis.dynamic]
end       = 2 s
tolerance = 1e-9
[output]
every    = 0.1 s
channels = energy.dissipated_damper energy.drive_work
"""


@pytest.mark.parametrize("method, near", [("verner", 1e-6), ("dop853", 1e-6), ("radau", 1e-5), ("rock4", 1e-4)])
def test_work_on_what_cannot_move(gudgeon, method, near):
    """A driven arm pulls at a block that is held: no state has an error, and the works are those of the closed motion."""
    directory = scratch()
    call(gudgeon, "run", written(directory, TIED), "--method", method, "--out", directory / "out", "--quiet", "--write", "channels")
    run = Run(directory / "out")
    t = np.linspace(0, 2, 200001)
    length = np.sqrt(0.25 + 0.36 - 0.6 * np.cos(20 * t))
    rate = 6 * np.sin(20 * t) / length
    loss = trapezoid(5 * rate**2, t)
    stored = 500 * ((length[-1] - 0.1) ** 2 - (length[0] - 0.1) ** 2)
    assert_close(run.read("energy/dissipated_damper").ravel()[-1], loss, relative=near)
    assert_close(run.read("energy/drive_work").ravel()[-1], loss + stored, relative=near)


def test_hertz_gives_back_what_it_got(gudgeon):
    """With Hertz' law the first impact loses nothing and leaves the elastic energy at zero."""
    run = finished(gudgeon, "--tolerance", "1e-10", "--set", "law=hertz", changes=ALL)
    assert abs(run.contacts["energy_lost"][0]) < 1e-12
    elastic = parts(run)["elastic"]
    assert elastic.min() >= 0.0 and elastic.max() > 0.1
    apart = run.read("clearances/contacts/penetration")[:, 0] == 0.0
    assert np.all(elastic[apart] == 0.0)


@pytest.mark.parametrize("deck", LOOSE, ids=[deck.stem for deck in LOOSE])
def test_decks_with_loose_joints_close(gudgeon, deck):
    """As they stand: the residual stays below 1e-6 of the energy that comes and goes. Where contacts stick, auto goes over to radau, whose
    quadratures have 100 times the tolerance of the greatest energy; verner is held to 1e-6 there."""
    directory = scratch()
    for beside in deck.parent.glob("*.txt"):  # tables that decks name
        shutil.copy(beside, directory)
    text = changed(deck.read_text(), "output", figures=None, channels=None)
    call(gudgeon, "run", written(directory, text), "--out", directory / "out", "--quiet")
    run = Run(directory / "out")
    allowed = 100 * OFTEN.get(deck.stem, 1)
    assert run.summary["energy_residual_max"] < allowed * run.summary["tolerance"] * run.summary["energy_max"]
    if deck.stem in ("incline", "friction"):
        call(gudgeon, "run", written(directory, text), "--method", "verner", "--out", directory / "verner", "--quiet")
        run = Run(directory / "verner")
    assert run.summary["ledger"] is True
    assert len(run.contacts) > 0 or "[lubricant]" in text  # where films hold the surfaces apart
    energy = parts(run)
    stored = energy["kinetic"] + energy["potential"] + energy["elastic"]
    exchanged = stored.max() - stored.min()
    assert exchanged > 0.0
    if deck.stem == "worn_bush":  # most of the energy is that of the shaft's rotation, which does not change
        assert run.summary["energy_residual_max"] < 1e-6 * run.summary["energy_max"]
        return
    assert run.summary["energy_residual_max"] < 1e-6 * exchanged
