"""Random scenes with Coulomb's friction, a few of each kind by every method; `make stability` runs hundreds.

And scenes whose first contact begins without sliding, where the normal force is none yet: what sticks and what slips there is no
more than round-off says.
"""

import dataclasses
import re
import sys

import numpy as np
import pytest
from support import ROOT, Run, call, scratch, written

sys.path.insert(0, str(ROOT / "tests" / "stability"))
from friction_runs import GIVEN, differences, disagreement, faults_of, mistakes_of, run, work_within  # noqa: E402
from random_friction import KINDS, METHODS, draw  # noqa: E402

EACH = 2  # scenes of a kind
ENDLESS = (  # slow slip in space against its direction, and slip at a vanishing normal force
    ("block", 38, "radau"), ("disc", 28, "bdf"), ("disc", 75, "adams"), ("bushing", 40, "bdf"), ("block", 92, "bdf"),
    ("block", 38, "bdf"), ("socket", 43, "dop853"))
REGULAR = [("disc", seed) for seed in (12, 18, 65, 67, 79, 83, 98)] + [("socket", 25), ("socket", 99)]  # few contacts
TOGETHER = (3, 17, 96)  # blocks whose corners on one face begin to slip together
CREEPING = (("block", 11), ("block", 18))  # corners on one face slide against one another as the block turns
STRAIGHT = (75, 99)  # three equal pins of a body that falls straight: they start together, without sliding
HELD = (20, 24, 28, 43, 53, 81, 98)  # sockets: two contacts stick, the third one is at its limit and next to rest

PIN = """deck = 1
[scene]
gravity = 0 -9.81 m/s^2
[analysis.dynamic]
end = 0.2 s
tolerance = 1e-8
start = ideal
method = METHOD
[output]
every = 1 ms
channels = energy.* b.position
[material]
name young[GPa] poisson
steel 207 0.3
[bodies]
name mass[kg] inertia[kg.m^2] x[m] y[m] angle[rad]
b 0.456281 0.00062879 -0.00706853996 0.117178411 1.6310462
[points]
name body xi[m] eta[m]
g ground 0 0
p b -0.117391415 0
[clearance.revolute]
name bearing journal bearing_radius[m] clearance[m] length[m] material law friction
j g p 0.015 0.000303093 0.02 steel law fr
[contact.lankarani_nikravesh]
name restitution
law 0.535
[friction.coulomb]
name coefficient static_coefficient
fr 0.1885 0.2261
"""

BALL = """deck = 1
[scene]
space = spatial
gravity = 0 0 -9.81 m/s^2
[analysis.dynamic]
end = 0.2 s
tolerance = 1e-8
start = ideal
method = METHOD
[output]
every = 1 ms
channels = energy.* b.position
[material]
name young[GPa] poisson
steel 207 0.3
[bodies]
name mass[kg] ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2] x[m] y[m] z[m] axis angle[rad]
b 0.718336 0.00492444 0.00541688 0.00443199 0.0125707868 -0.0677429137 -0.252599078 "-0.977080816023 -0.00142880974373 0.212863894221" 2.67105639
[points]
name body xi[m] eta[m] zeta[m]
g ground 0 0 0
p b -0.103977753289 -0.171240785099 -0.168578294779
[clearance.spherical]
name bearing journal bearing_radius[m] clearance[m] material law friction
j g p 0.015 0.000309065 steel law fr
[contact.exact]
name restitution
law 0.639
[friction.coulomb]
name coefficient static_coefficient
fr 0.1641 0.0000
"""


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("kind", KINDS)
def test_random_scenes_end(gudgeon, kind, method):
    """No failure, no crawl, energy kept, friction takes energy only."""
    for seed in range(EACH):
        mistakes = mistakes_of(gudgeon, draw(kind, seed), method, scratch())
        assert not mistakes, f"{kind} {seed}, {method}: {'; '.join(mistakes)}"


@pytest.mark.parametrize(("kind", "seed"), CREEPING)
def test_creeping_needs_no_small_steps(gudgeon, kind, seed):
    """An explicit method follows contacts that creep against one another with few steps."""
    mistakes = mistakes_of(gudgeon, draw(kind, seed), "verner", scratch())
    assert not mistakes, "; ".join(mistakes)


@pytest.mark.parametrize("seed", HELD)
def test_contacts_that_others_hold_need_no_small_steps(gudgeon, seed):
    """An explicit method follows a slip next to rest, whose direction turns fast."""
    mistakes = mistakes_of(gudgeon, draw("socket", seed), "verner", scratch())
    assert not mistakes, "; ".join(mistakes)


@pytest.mark.parametrize("method", ["verner", "bdf", "radau"])
def test_no_slow_slip_is_driven_by_its_friction(gudgeon, method):
    """A body comes to rest in three sockets, where slow slips hold one another: in all rows friction gives no more than in one."""
    scene = draw("socket", 28)
    result = run(gudgeon, scene, method, "coulomb", scratch())
    given = np.maximum(-np.diff(result.read("energy/dissipated_friction").ravel()) - np.diff(work_within(result, True)), 0.0)
    assert np.sum(given) < GIVEN*result.summary["energy_max"]


@pytest.mark.parametrize(("kind", "seed", "method"), ENDLESS)
def test_no_events_or_steps_without_end(gudgeon, kind, seed, method):
    """After a decision no event function of a slip is beyond its end."""
    mistakes = mistakes_of(gudgeon, draw(kind, seed), method, scratch())
    assert not mistakes, "; ".join(mistakes)


@pytest.mark.parametrize(("law", "method"), [("constant", "dop853"), ("constant", "bdf"), ("constant_dry", "verner"), ("constant_dry", "bdf")])
def test_constant_friction_where_it_holds_the_normal_force_at_zero(gudgeon, method, law):
    """Friction of one pin presses the surfaces together, and without it they part: a force that jumps there makes steps without end."""
    scene, directory = draw("pin", 0), scratch()
    result = run(gudgeon, scene, method, law, directory)
    assert not isinstance(result, str), result
    assert not faults_of(result, scene, method, lambda: run(gudgeon, scene, method, "smooth", directory))


@pytest.mark.parametrize("seed", TOGETHER)
def test_round_off_does_not_choose_what_slips(gudgeon, seed):
    """Two corners on one face share friction; with a mass that differs in its last digits the same contacts slip and stick, in the same order."""
    scene = draw("block", seed)
    mass = re.search(r"^b (\S+)", scene.text, re.MULTILINE)[1]
    orders = []
    for k in range(4):
        text = scene.text.replace(f"\nb {mass} ", f"\nb {float(mass)*(1.0 + 1e-13*k)!r} ")
        directory = scratch()
        call(gudgeon, "run", written(directory, text), "--method", "verner", "--out", directory / "out", "--quiet")
        rows = (line.split() for line in (directory / "out" / "events.dat").read_text().splitlines() if line.strip() and line[0] != "#")
        orders.append([(row[1], *row[3:6]) for row in rows])
    assert any(row[0] == "slip" for row in orders[0])
    assert orders[1:] == orders[:1]*3


@pytest.mark.parametrize("kind", KINDS)
def test_two_methods_agree_on_the_first_contact(gudgeon, kind):
    """verner and bdf, on its onset and its impulse."""
    for seed in range(EACH):
        words = disagreement(gudgeon, draw(kind, seed), scratch())
        assert not words, f"{kind} {seed}: {'; '.join(words)}"


@pytest.mark.parametrize(("kind", "seed"), REGULAR)
def test_two_methods_agree_where_contacts_are_few(gudgeon, kind, seed):
    """verner and bdf, on what friction takes, on all impulses and on the last place."""
    scene, directory = draw(kind, seed), scratch()
    runs = [run(gudgeon, scene, method, "coulomb", directory) for method in ("verner", "bdf")]
    assert runs[0].read("energy/dissipated_friction").ravel()[-1] > 0.0
    assert not differences(*runs)


@pytest.mark.parametrize("method", METHODS[:2] + METHODS[3:])
@pytest.mark.parametrize("text", (PIN, BALL), ids=("pin", "ball"))
def test_a_contact_that_begins_without_sliding(gudgeon, text, method):
    """The pendulum falls straight onto its bearing: it comes to the end, and friction takes energy only."""
    directory = scratch()
    call(gudgeon, "run", written(directory, text.replace("METHOD", method)), "--out", directory / "out", "--quiet", "--write", "channels")
    done = Run(directory / "out")
    assert done.summary["status"] == "complete"
    assert np.all(np.diff(done.read("energy/dissipated_friction").ravel()) >= -1e-9*done.summary["energy_max"])
    assert done.summary["energy_residual_max"] < 1e-4*done.summary["energy_max"]
    assert done.summary["events"] < 1000


@pytest.mark.parametrize("seed", STRAIGHT)
def test_pins_that_start_together(gudgeon, seed):
    """Which of the pins slip first does not hang on round-off: first impulses by all methods, to within 1e-4 (bdf at tolerance 1e-8)."""
    runs = [run(gudgeon, draw("pin", seed), method, "coulomb", scratch()) for method in ("verner", "dop853", "radau", "bdf")]
    impulses = [result.contacts["impulse"][0] for result in runs]
    assert max(impulses) - min(impulses) < 1e-4 * impulses[0], impulses


def test_slip_ends_with_the_motion_of_its_event(gudgeon):
    """A slip in space that ends while rows are written between steps sticks: the first impulses agree at every tolerance."""
    impulses = []
    for method, tolerance in (("dop853", "1e-10"), ("verner", "1e-8"), ("verner", "1e-9"), ("radau", "1e-9"), ("bdf", "1e-9")):
        scene = draw("bushing", 5)
        scene = dataclasses.replace(scene, text=scene.text.replace("tolerance = 1e-8", f"tolerance = {tolerance}"))
        impulses.append(run(gudgeon, scene, method, "coulomb", scratch()).contacts["impulse"][0])
    assert impulses == pytest.approx([impulses[0]] * len(impulses), rel=1e-5)  # 3e-3 where it went on slipping
