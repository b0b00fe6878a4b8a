"""What a run warns of: on the standard error, in summary.json and run.h5, and nowhere if there is nothing to warn of."""

import numpy as np
import pytest
from support import DECK, Run, assert_close, call, changed, finished, plain_deck, scratch, written

ASSEMBLY = 4

PENDULUM = """deck = 1
[scene]
gravity = 0 -9.81 m/s^2
[bodies]
name   mass[kg]  inertia[kg.m^2]  x[m]  y[m]  vx[m/s]  vy[m/s]  omega[rad/s]
stone  1         1                9     9     -        -        -
bob    2         0.05             0.4   0     -        -        5
[points]
name   body    xi[m]  eta[m]
hook   ground  0      0
eye    bob     -0.4   0
nail   ground  0.8    0
toe    bob     0.4    0
[joint.revolute]
name   i       j
pin    hook    eye
[analysis.dynamic]
end = 0.1 s
[output]
channels = bob.*
"""

LOOSE = """[material]
name   young[GPa]  poisson
steel  207         0.3
[clearance.revolute]
name   bearing  journal  bearing_radius[mm]  clearance[mm]  material  law    level
ring   nail     toe      10                  0.5            steel     hertz  LEVEL
[contact.hertz]
name
hertz
"""

DRIVER = """[driver.angle]
name   joint  angle
motor  pin    {0.3 rad*step(t - 0.05 s)}
"""


def run_text(program, text, *options, expect=0):
    """Run a deck given as text."""
    directory = scratch()
    done = call(program, "run", written(directory, text), "--out", directory / "out", *options, expect=expect)
    return Run(directory / "out", done)


def one_warning(run):
    """The only warning of a run, which also stands on the standard error."""
    warnings = run.summary["warnings"]
    assert len(warnings) == 1, warnings
    assert f"warning: {warnings[0]}" in run.done.stdout + run.done.stderr
    assert list(run.read("warnings")) == warnings
    assert run.summary["status"] == "complete"
    return warnings[0]


def test_given_speed_is_kept(gudgeon):
    """Only omega is given: the pendulum starts with it, its centre follows, nothing is warned of."""
    run = run_text(gudgeon, PENDULUM)
    assert run.summary["warnings"] == []
    assert "warning" not in run.done.stderr
    assert_close(run.item("bodies/angular_velocity", "bob")[0], 5.0, relative=1e-7)
    assert_close(run.item("bodies/velocity", "bob")[0], [0.0, 2.0], absolute=1e-6)


def test_contradicting_velocity(gudgeon):
    """A velocity that the pin does not allow is changed; the warning names the body and the change."""
    run = run_text(gudgeon, PENDULUM.replace("0     -        -        5", "0     3        -        5"))
    words = one_warning(run)
    assert "'bob'" in words and "3 m/s" in words and "stone" not in words
    assert_close(run.item("bodies/velocity", "bob")[0], [0.0, 2.0], absolute=1e-6)


def test_defaults_that_change(gudgeon):
    """A body without given velocities on a driven joint moves with it, without a warning."""
    run = run_text(gudgeon, PENDULUM.replace("-        5", "-        -").replace("[analysis", "[driver.speed]\nname joint "
                   "speed[rad/s]\nmotor pin 7\n[analysis"))
    assert run.summary["warnings"] == []
    assert_close(run.item("bodies/velocity", "bob")[0], [0.0, 2.8], absolute=1e-12)


@pytest.mark.parametrize("start", ["ideal", "given"])
def test_velocity_of_a_loose_body(gudgeon, start):
    """start = ideal drops the velocity of a body on a loose pin, with a warning; start = given keeps it."""
    text = PENDULUM.split("[joint.revolute]")[0].replace("0.4   0     -        -        5", "0     0     2        -        -")
    text += LOOSE.replace("LEVEL", "clearance").replace("nail     toe", "hook     middle")
    text = text.replace("toe    bob     0.4    0", "middle bob     0      0") + PENDULUM[PENDULUM.index("[analysis") :]
    run = run_text(gudgeon, changed(text, "analysis.dynamic", start=start, end="1 ms"))
    velocity = run.item("bodies/velocity", "bob")[0]
    if start == "ideal":
        words = one_warning(run)
        assert "'bob'" in words and "2 m/s" in words
        assert_close(velocity, [0.0, 0.0], absolute=1e-14)
    else:
        assert run.summary["warnings"] == []
        assert_close(velocity, [2.0, 0.0])


def redundant(level, figures):
    """A pendulum held by an ideal pin and, in parallel, by a second one."""
    text = PENDULUM.replace("-        5", "-        -").replace("[analysis", LOOSE.replace("LEVEL", level) + "[analysis")
    text = changed(text, "analysis.dynamic", start="ideal", end="20 ms")
    return changed(text, "output", channels="bob.* ring.*", figures=figures)


def test_redundant_twin(gudgeon):
    """Rows that are redundant with all joints ideal: the loose mechanism runs without a word, its figures overlay the twin."""
    run = run_text(gudgeon, redundant("clearance", "bob.velocity ring.orbit"))
    assert run.summary["warnings"] == []
    assert run.summary["contacts"] > 0
    assert {path.name for path in run.directory.glob("figures/*.png")} == {"bob.velocity.png", "ring.orbit.png"}
    assert list(run.directory.rglob("*.ideal.dat"))


@pytest.mark.parametrize("options", [(), ("--ideal",)])
def test_redundant_system(gudgeon, options):
    """In the system that runs, redundant rows are told, with the names of all joints that share the load; the body rests, and
    the two pins together carry its weight."""
    text = redundant("clearance" if options else "ideal", None)
    text = changed(text, "output", channels="bob.* pin.* ring.force")
    run = run_text(gudgeon, text, *options)
    words = one_warning(run)
    assert "redundant constraints: 1 of 4 rows" in words and "'pin'" in words and "'ring'" in words
    for channel in ("position", "velocity", "acceleration"):
        start = run.item(f"bodies/{channel}", "bob")[0]
        assert_close(run.item(f"bodies/{channel}", "bob"), start + 0.0 * run.item(f"bodies/{channel}", "bob"), absolute=1e-12)
    assert_close(run.item("bodies/acceleration", "bob")[0], [0.0, 0.0], absolute=1e-12)
    assert_close(run.item("joints/force", "pin")[0] - run.item("clearances/force", "ring")[0], [0.0, -2.0 * 9.81], absolute=1e-9)
    for verb in ("check", "explain"):
        done = call(gudgeon, verb, written(scratch(), text), *options)
        assert verb == "check" or "redundant constraints: 1 of 4 rows" in done.stdout


def test_ideal_leaves_out(gudgeon):
    """--ideal: channels and figures of the contact are left out with a warning each, the rest is there."""
    text = changed(DECK.read_text(), "analysis.dynamic", end="1 ms")
    text = changed(text, "output", channels="slider.velocity gudgeon.penetration", figures="slider.velocity gudgeon.orbit")
    run = run_text(gudgeon, text, "--ideal")
    warnings = run.summary["warnings"]
    assert len(warnings) == 2
    assert "'gudgeon.penetration' omitted" in warnings[0] and "'gudgeon.orbit' omitted" in warnings[1]
    assert all(f"warning: {words}" in run.done.stdout + run.done.stderr for words in warnings)
    assert [path.name for path in run.directory.glob("figures/*.png")] == ["slider.velocity.png"]
    names = [name for path in run.directory.glob("*.dat") if path.name != "events.dat" for name in run.table(path.name)[0]]
    assert any("velocity" in name for name in names) and not any("penetration" in name for name in names)
    call(gudgeon, "check", written(scratch(), text), "--ideal")
    call(gudgeon, "explain", written(scratch(), text), "--ideal")


def test_ideal_still_knows_words(gudgeon):
    """With --ideal a misspelt channel is the mistake that it is without."""
    text = changed(plain_deck(), "output", channels="gudgeon.penetratoin")
    for options in ((), ("--ideal",)):
        done = call(gudgeon, "check", written(scratch(), text), *options, expect=3)
        assert "penetratoin" in done.stderr


def test_jump_of_a_driver(gudgeon):
    """A driver that jumps: the run is complete, and a warning names the driver and the jump."""
    run = run_text(gudgeon, PENDULUM.replace("-        5", "-        -").replace("[analysis", DRIVER + "[analysis"))
    words = one_warning(run)
    assert "'motor'" in words and "0.3 rad" in words and "jump" in words


def test_ledger_that_does_not_close(gudgeon):
    """In steps as long as an impact the ledger does not close: a warning says by how much. At tolerance 1e-8 there is none."""
    run = finished(gudgeon, changes=tuple(("analysis.dynamic", key, value) for key, value in (
        ("end", "1 ms"), ("method", "rk4"), ("step", "50 us"), ("tolerance", None))))
    words = one_warning(run)
    assert "energy balance violated" in words
    told = next(float(word) for word in words.split() if word[0].isdigit())
    assert_close(told, run.summary["energy_residual_max"] / run.summary["energy_max"], relative=6e-3)
    assert told > 1e-3
    assert not any("energy balance" in words for words in finished(gudgeon, "--tolerance", "1e-8").summary["warnings"])


def test_a_ledger_that_nearly_closes(gudgeon):
    """A pendulum in fixed steps: from a residual of 1e-4 of the largest energy on a warning tells it, with its limit."""
    text = PENDULUM.replace("stone  1         1                9     9     -        -        -\n", "")
    for step, is_told in (("40 ms", False), ("80 ms", True)):
        run = run_text(gudgeon, changed(text.replace("-        5", "-        -"), "analysis.dynamic", end="3 s", method="rk4", step=step))
        residual = run.summary["energy_residual_max"]/run.summary["energy_max"]
        assert (1e-4 < residual < 1e-3) if is_told else residual < 1e-4
        if is_told:
            assert "energy balance violated" in one_warning(run) and "(limit 0.0001)" in one_warning(run)
        else:
            assert not run.summary["warnings"]


def test_impacts_too_fast_for_the_law(gudgeon):
    """The dry slider-crank hits at some m/s: waves in steel take a few per cent of that at most, and nothing is warned of. Of a material
    in which waves are slow one warning names joint, law, speed, limit and what the waves take."""
    run = finished(gudgeon)
    assert run.summary["warnings"] == [] and len(run.read("warnings")) == 0
    fastest = run.contacts["impact_speed"].max()
    assert 0.05 < fastest < 30
    heavy = plain_deck().replace("0.3       7850", "0.3       1e8")
    assert "1e8" in heavy
    words = one_warning(run_text(gudgeon, heavy))
    assert "'gudgeon'" in words and "'lankarani_nikravesh'" in words and "restitution measured" in words
    told = float(words.split(" m/s")[0].split()[-1])
    assert_close(told, fastest, relative=6e-3)
    waves = np.sqrt(207e9 / 1e8)
    share = float(words.split("take ")[1].split(" %")[0])
    assert_close(share, 104 * (told / waves) ** 0.6, relative=0.05, what="share of waves")
    limit = float(words.split("limit 10 %, ")[1].split(" m/s")[0])
    assert_close(limit, waves * (0.1 / 1.04) ** (5 / 3), relative=6e-3, what="limit")


def test_waves_are_explained(gudgeon):
    """`explain` says what elastic waves take of the energy of an impact in steel: 0.62 % at 1 m/s, 10 % at 104 m/s."""
    said = call(gudgeon, "explain", DECK).stdout
    assert "take 0.62 % of the energy of an impact at 1 m/s and 10 % at 104 m/s (Hunter 1957" in said


def test_penetration_beyond_the_law(gudgeon):
    """A bearing so short that the contact leaves the range of a cylinder law: a warning says so."""
    text = plain_deck().replace("  15           steel", "  0.5          steel")
    words = one_warning(run_text(gudgeon, text, "--set", "law=dubowsky_freudenstein"))
    assert "quasi-static" not in words and "penetration up to" in words and "tangent" in words


def test_open_contact_of_a_failed_run(gudgeon):
    """Steps are used up within a contact: its row is in run.h5 and in events.dat, without an end."""
    directory = scratch()
    text = plain_deck([("analysis.dynamic", "step", "5 us"), ("analysis.dynamic", "maximum_steps", "50")])
    done = call(gudgeon, "run", written(directory, text), "--out", directory / "out", expect=5)
    run = Run(directory / "out", done)
    assert "maximum_steps" in done.stderr and "deepest contact there: 'gudgeon'" in done.stderr
    assert run.summary["status"] == "failed"
    assert len(run.contacts) == 1 and run.contacts["impact_speed"][0] > 1.0 and run.contacts["peak_force"][0] > 1.0
    assert np.isnan(run.contacts["duration"][0]) and run.contacts["time"][0] < run.summary["time_end"]
    names, rows = run.table("events.dat")
    assert len(rows) == 1 and rows[0][names.index("duration")] == "NaN"
