"""Planes, balls, stops, racks and ends of guides in space: against closed forms and the plane, in frames that lie anyhow."""

import numpy as np
import pytest
from support import ROOT, Run, assert_close, call, changed, plain, scratch, written

G = 9.81
AXIS = np.array([2.0, -1.0, 2.0]) / 3  # a direction that is no axis of anything
ACROSS = np.array([1.0, 2.0, 0.0]) / np.sqrt(5)
THIRD = np.cross(AXIS, ACROSS)
WAYS = [{}, {"method": "dop853"}, {"method": "ida"}, {"method": "bdf"}, {"coordinates": "full"}]
SPREAD = "deck = 1\n[scene]\nspace = spatial\ngravity = {gravity} m/s^2\n"
BODIES = "[bodies]\nname mass[kg] ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2] x[m] y[m] z[m] vx[m/s] vy[m/s] vz[m/s] wx[rad/s] wy[rad/s] wz[rad/s]\n"
STEEL = "[material]\nname young[GPa] poisson\nsteel 207 0.3\n"


def words(*numbers):
    """Numbers of a row, or of a vector, as text."""
    return " ".join(f"{x:.17g}" for x in np.ravel(numbers))


def run(program, text, end, *options, every="1 ms", **settings):
    """Run a deck given as text."""
    directory = scratch()
    more = "".join(f"{key} = {value}\n" for key, value in ({"start": "given", "tolerance": "1e-10"} | settings).items())
    text = f"{text}[analysis.dynamic]\nend = {end}\n{more}[output]\nevery = {every}\n"
    done = call(program, "run", written(directory, text), "--out", directory / "out", "--quiet", *options)
    return Run(directory / "out", done)


def ball(velocity, spin, height, law, friction="none", gravity=(0, 0, 0), mass=0.2, radius=0.02):
    """A ball above a plane whose normal is AXIS."""
    inertia = 0.4 * mass * radius**2
    return (SPREAD.format(gravity=words(gravity)) + BODIES
            + f"ball {mass} {inertia:.17g} {inertia:.17g} {inertia:.17g} {words((radius + height) * AXIS + 0.3 * ACROSS, velocity, spin)}\n"
            + "[points]\nname body xi[m]\nfloor ground 0\ncentre ball 0\n" + STEEL + law
            + f'[clearance.plane]\nname plane ball axis_i radius[m] material law friction\nbed floor centre "{words(AXIS)}" {radius} steel hard '
            + f"{friction}\n")


@pytest.mark.parametrize("settings", WAYS[:4], ids=str)
def test_ball_bounces_on_a_plane(gudgeon, settings):
    """Onset at gap/v, Hertz's peak and duration, back at the same speed; what goes along the plane goes on."""
    mass, radius, speed = 0.2, 0.02, 1.5
    found = run(gudgeon, ball(-speed * AXIS + 0.7 * ACROSS, (0, 0, 0), 3e-3, "[contact.hertz]\nname\nhard\n"), "5 ms", **settings)
    (contact,) = found.contacts
    stiffness = 4 / 3 / (2 * (1 - 0.3**2) / 207e9) * np.sqrt(radius)
    depth = (5 * mass * speed**2 / (4 * stiffness)) ** 0.4
    assert_close(contact["time"], 3e-3 / speed, absolute=1e-9, what="onset")
    assert_close(contact["impact_speed"], speed, absolute=1e-7, what="impact speed")
    assert_close(contact["peak_force"], stiffness * depth**1.5, relative=1e-5, what="peak force")
    assert_close(contact["duration"], 2.94327 * depth / speed, relative=1e-5, what="duration")
    assert_close(found.item("bodies/velocity", "ball")[-1], speed * AXIS + 0.7 * ACROSS, absolute=1e-6, what="way back")


@pytest.mark.parametrize("settings", WAYS[:1] + WAYS[2:4], ids=str)
def test_ball_slides_and_then_rolls(gudgeon, settings):
    """Sliding friction takes mu g t until it rolls, with nearly 5 v/7; then it sticks and rolls on without loss."""
    mu, speed, mass, radius = 0.3, 0.6, 0.2, 0.02
    law = "[contact.hertz]\nname stiffness[N/m^1.5]\nhard 1e8\n[friction.coulomb]\nname coefficient\ndry 0.3\n"
    deep = (mass * G / 1e8) ** (2 / 3)
    found = run(gudgeon, ball(speed * ACROSS, (0, 0, 0), -deep, law, "dry", -G * AXIS), "90 ms", overlap="preload", **settings)
    arm = radius - deep / 2  # of the friction force
    rolling = speed / (1 + arm**2 / (0.4 * radius**2)) * arm**2 / (0.4 * radius**2)
    until = (speed - rolling) / (mu * G)
    velocity = found.item("bodies/velocity", "ball") @ ACROSS
    spin = found.item("bodies/angular_velocity", "ball") @ np.cross(AXIS, ACROSS)
    expected = np.where(found.time < until, speed - mu * G * found.time, rolling)
    assert_close(velocity, expected, absolute=2e-5 * speed, what="velocity")
    assert_close(spin, np.where(found.time < until, 2.5 * mu * G * found.time * (arm / radius)**2, rolling) / arm, absolute=2e-5 * speed / radius, what="spin")
    assert found.summary["energy_residual_max"] < 1e-6 * found.summary["energy_max"]


def test_two_balls_are_those_of_the_plane(gudgeon):
    """The shot of billiards in a plane of space that lies anyhow: onset, peak, velocities and spins of both balls."""
    text = (ROOT / "inputs/billiards.deck").read_text()
    directory = scratch()
    call(gudgeon, "run", written(directory, text), "--out", directory / "plane", "--quiet", "--write", "channels")
    flat = Run(directory / "plane")
    r = 0.0286
    rows = "".join(f"{name} 0.17 5.56e-5 5.56e-5 5.56e-5 {words(x * ACROSS + y * THIRD, v * ACROSS, (0, 0, 0))}\n"
                   for name, x, y, v in (("cue", -0.15, 0, 2), ("object", 0, -r, 0)))
    tail = text[text.index("[material]"):text.index("[analysis.dynamic]")]
    head = SPREAD.format(gravity="0 0 0") + text[text.index("[parameters]"):text.index("[bodies]")]
    found = run(gudgeon, head + BODIES + rows + "[points]\nname body xi[m]\nc cue 0\no object 0\n" + tail, "150 ms")
    for field in ("time", "impact_speed", "peak_force", "duration"):
        assert_close(found.contacts[field], flat.contacts[field], relative=1e-8, what=field)
    for name in ("cue", "object"):
        velocity = found.item("bodies/velocity", name)[-1]
        assert_close([velocity @ ACROSS, velocity @ THIRD], flat.item("bodies/velocity", name)[-1], absolute=1e-8, what="velocity")
        assert_close(velocity @ AXIS, 0.0, absolute=1e-12, what="in its plane")
        # AXIS x ACROSS = THIRD: AXIS is where z was
        spin = found.item("bodies/angular_velocity", name)[-1] @ AXIS
        assert_close(spin, flat.item("bodies/angular_velocity", name)[-1], absolute=1e-6, what="spin")


def tied(kind, limits, velocity, spin, lever=0.25):
    """A bar that a joint along AXIS ties to the ground, the joint's point at its middle, with a stop."""
    return (SPREAD.format(gravity="0 0 0") + BODIES + f"bar 3 0.16 0.16 0.16 {words((0.1, 0.2, 0.3), velocity, spin)}\n"
            + "[points]\nname body xi[m] eta[m] zeta[m]\naxle ground 0.1 0.2 0.3\nmiddle bar 0 0 0\n"
            + f'[joint.{kind}]\nname i j axis_i{"" if kind == "translational" else " zero"}{" pitch[mm]" if kind == "screw" else ""}\n'
            + f'pin axle middle "{words(AXIS)}"{"" if kind == "translational" else " start"}{" 20" if kind == "screw" else ""}\n'
            + "[contact.exact]\nname stiffness[N/m^1.5] restitution\nhard 1e10 0.7\n"
            + f"[clearance.stop]\nname joint {' '.join(limits)} lever[m] law\nbump pin {' '.join(limits.values())} {lever} hard\n")


@pytest.mark.parametrize("kind, settings", [("revolute", way) for way in WAYS] + [("cylindrical", way) for way in WAYS[:3]], ids=str)
@pytest.mark.parametrize("side", [1, -1])
def test_bar_turns_against_its_stop(gudgeon, kind, side, settings):
    """Onset at angle/w, impact speed l w, back with c_e w, whichever way it turns; along its axis it goes on."""
    rate, along = side * 4.0, 0.3 if kind == "cylindrical" else 0.0
    found = run(gudgeon, tied(kind, {"lower[deg]": "-25", "upper[deg]": "40"}, along * AXIS, rate * AXIS), "0.2 s", **settings)
    limit = np.radians(40 if side > 0 else -25)
    first = found.contacts[0]
    assert plain(first["contact"]).strip() == ("upper" if side > 0 else "lower")
    assert_close(first["time"], limit / rate, absolute=1e-9, what="onset")
    assert_close(first["impact_speed"], 0.25 * 4.0, relative=1e-8, what="impact speed")
    k = int(np.searchsorted(found.time, first["time"] + 4e-3))
    assert_close(found.item("bodies/angular_velocity", "bar")[k], -0.7 * rate * AXIS, absolute=1e-4 * 4, what="rebound")
    assert_close(found.item("bodies/velocity", "bar")[k], along * AXIS, absolute=1e-7, what="along the axis")
    assert abs(found.read("energy/residual")).max() < 1e-5


@pytest.mark.parametrize("kind", ["translational", "cylindrical", "screw"])
def test_bar_slides_against_its_stop(gudgeon, kind):
    """Onset at gap/v, back with c_e v; on a screw, whose turn comes back too, what the contact takes is what the motion has lost."""
    speed = 0.5
    spin = 2 * np.pi / 0.02 * speed * AXIS if kind == "screw" else 0 * AXIS
    found = run(gudgeon, tied(kind, {"upper[mm]": "30", "lower[mm]": "-20"}, speed * AXIS, spin), "0.13 s")
    first = found.contacts[0]
    assert_close(first["time"], 0.03 / speed, absolute=1e-9, what="onset")
    k = int(np.searchsorted(found.time, first["time"] + first["duration"])) + 1
    back = found.item("bodies/velocity", "bar")[k]
    if kind != "screw":
        assert_close(back, -0.7 * speed * AXIS, absolute=1e-4, what="rebound")
    moved = 3 + (0.16 * (2 * np.pi / 0.02) ** 2 if kind == "screw" else 0)
    lost = found.read("energy/dissipated_contact").ravel()[k]
    assert_close(0.5 * moved * (speed**2 - back @ back), lost, relative=1e-6, what="lost in the contact")


def test_limits_of_a_joint_that_turns_only(gudgeon):
    """A length for a pin is refused, with its place; so is a guide that is shorter than its block."""
    text = tied("revolute", {"lower[mm]": "-25"}, 0 * AXIS, 0 * AXIS) + "[analysis.dynamic]\nend = 1 s\n"
    done = call(gudgeon, "check", written(scratch(), text), expect=3)
    assert "column lower is an angle there" in done.stderr and "scene.deck:" in done.stderr
    end = "[analysis.dynamic]\nend = 1 s\n[output]\nevery = 1 ms\n"
    done = call(gudgeon, "check", written(scratch(), block(0, 0.02, 0.04) + end), expect=3)
    assert "shorter than the block" in done.stderr and "^" in done.stderr
    done = call(gudgeon, "check", written(scratch(), block(0, 0.02, 0.01) + end), expect=3)
    assert "guide_end must be beyond guide_start" in done.stderr


def rack(side, radius=0.08):
    """A rack that falls along -AXIS and turns a pinion about THIRD; its line has the pinion on its left or right."""
    frame = 'xi_axis eta_axis'
    at = -side * radius * ACROSS  # AXIS up, THIRD towards the viewer: the left of the line is along THIRD x AXIS = ACROSS
    return (SPREAD.format(gravity=words(-G * AXIS))
            + f"[bodies]\nname mass[kg] ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2] x[m] y[m] z[m] {frame}\n"
            + f'rack 3 0.1 0.2 0.1 {words(0.2 * AXIS)} "{words(AXIS)}" "{words(THIRD)}"\n'
            + f'pinion 2 0.01 0.01 0.004 {words(at + 0.5 * AXIS)} "1 0 0" "0 1 0"\n'
            + "[points]\nname body xi[m] eta[m] zeta[m]\nrail ground 0 0 0\nfoot rack -0.2 0 0\nline rack 0.1 0 0\n"
            + f"axle ground {words(at + 0.5 * AXIS)}\nmiddle pinion 0 0 0\n"
            + f'[joint.translational]\nname i j axis_i\nguide rail foot "{words(AXIS)}"\n'
            + f'[joint.revolute]\nname i j axis_i\nbearing axle middle "{words(THIRD)}"\n'
            + f'[joint.rack]\nname i j axis_i axis_j radius[m]\nteeth line middle "1 0 0" "{words(THIRD)}" {-side * radius}\n')


@pytest.mark.parametrize("settings", [*WAYS, {"stabilise": "baumgarte alpha=5s^-1 beta=5s^-1"}, {"solver": "sparse"}], ids=str)
@pytest.mark.parametrize("side", [-1, 1])
def test_rack_and_pinion(gudgeon, settings, side):
    """It falls with m g/(m + I/R^2) over five turns of the pinion; the teeth carry I a/R^2, at the line."""
    radius = 0.08
    inertia = np.array([0.01, 0.01, 0.004]) @ THIRD**2  # of the pinion about its axis
    off = np.array([0.01, 0.01, 0.004]) * THIRD - inertia * THIRD
    assert np.linalg.norm(off) > 1e-4  # its axis is no principal one
    found = run(gudgeon, rack(side), "0.9 s", every="10 ms", **settings)
    fall = 3 * G / (3 + inertia / radius**2)
    time = found.time
    assert_close(found.item("bodies/position", "rack") @ AXIS, 0.2 - fall * time**2 / 2, absolute=2e-7 * fall, what="height of the rack")
    spin = found.item("bodies/angular_velocity", "pinion") @ THIRD
    assert_close(spin, side * fall * time / radius, absolute=1e-5 * fall / radius, what="pinion")
    assert fall * 0.9**2 / 2 / radius > 8 * np.pi
    force = found.item("joints/force", "teeth")
    assert_close(force @ AXIS, inertia * fall / radius**2 + 0 * time, absolute=1e-4 * fall, what="force on the rack")
    assert_close(np.linalg.norm(np.cross(force, AXIS), axis=1), 0 * time, absolute=1e-4 * fall, what="no force across")
    moment = found.item("joints/moment", "teeth")
    assert_close(np.linalg.norm(moment, axis=1), 0 * time, absolute=1e-4 * fall, what="no couple where they touch")


def test_rack_in_kinematics_and_after_a_restart(gudgeon):
    """Driven at the pinion, the rack goes R w t back, for it lies to the left of the pinion, over many turns; a run that was stopped and resumed is the same bit for bit."""
    text = rack(1) + "[driver.speed]\nname joint speed\nmotor bearing 20rad/s\n"
    deck = written(scratch(), text + "[analysis.kinematic]\nend = 2 s\n[output]\nevery = 20 ms\n")
    call(gudgeon, "run", deck, "--out", deck.parent / "out", "--quiet")
    found = Run(deck.parent / "out")
    assert_close(found.item("bodies/position", "rack") @ AXIS, 0.2 - 0.08 * 20 * found.time, absolute=1e-9, what="rack")
    deck = written(scratch(), rack(1) + "[analysis.dynamic]\nend = 0.3 s\n[output]\nevery = 10 ms\n")
    call(gudgeon, "run", deck, "--out", deck.parent / "out", "--quiet", "--verify-restart")


def test_rack_along_its_pinions_axis(gudgeon):
    """Line and axis that are not perpendicular are refused by name."""
    text = rack(1).replace('"1 0 0" "' + words(THIRD), '"1 0.1 0" "' + words(THIRD))
    done = call(gudgeon, "run", written(scratch(), text + "[analysis.dynamic]\nend = 0.1 s\n[output]\nevery = 10 ms\n"), "--out",
                scratch() / "out", "--quiet", expect=4)
    assert "'teeth' rolls on a line that is not perpendicular to the axis of the pinion" in done.stderr


def block(speed, start, end, sideways=0.0, spin=0.0):
    """A block of 50 mm in a guide along AXIS with ends; its own axes are the world's."""
    return (SPREAD.format(gravity="0 0 0") + BODIES + f"block 1 1e-3 1e-3 1e-3 0 0 0 {words(speed * AXIS + sideways * THIRD, spin * ACROSS)}\n"
            + "[points]\nname body xi[m]\ntrack ground 0\npin block 0\n" + STEEL
            + "[contact.lankarani_nikravesh]\nname stiffness[N/m^1.5] restitution\ndry 1e9 0.9\n"
            + "[friction.ambrosio]\nname coefficient v0[m/s] v1[m/s]\nrub 0.1 1e-4 1e-3\n"
            + "[clearance.translational]\nname guide slider axis_i width_axis width[mm] height[mm] length[mm] gap[mm] guide_start[m] "
            + f'guide_end[m] corner_radius[mm] material law friction\nrail track pin "{words(AXIS)}" "{words(ACROSS)}" 40 50 50 0.1 {start:.17g} '
            + f"{end:.17g} 1 steel dry rub\n")


def flat_block(speed, start, end, sideways, spin):
    """The same in the plane: a corner stands for two."""
    return ("deck = 1\n[scene]\ngravity = 0 0 m/s^2\n[bodies]\nname mass[kg] inertia[kg.m^2] x[m] y[m] vx[m/s] vy[m/s] omega[rad/s]\n"
            + f"block 1 1e-3 0 0 {speed} {sideways} {-spin}\n[points]\nname body xi[m] eta[m]\ntrack ground 0 0\npin block 0 0\n" + STEEL
            + "[contact.lankarani_nikravesh]\nname stiffness[N/m^1.5] restitution\ndry 2e9 0.9\n"
            + "[friction.ambrosio]\nname coefficient v0[m/s] v1[m/s]\nrub 0.1 1e-4 1e-3\n"
            + "[clearance.translational]\nname guide slider axis length[mm] height[mm] gap[mm] guide_start[m] guide_end[m] "
            + f"corner_radius[mm] material law friction\nrail track pin x 50 50 0.1 {start:.17g} {end:.17g} 1 steel dry rub\n")


@pytest.mark.parametrize("way", ["leaves", "leaves while it touches"])
def test_block_leaves_its_guide(gudgeon, way):
    """Corners that pass an end touch no more: a block that turns is that of the plane, contact by contact, each of two corners."""
    speed, sideways, spin, end = (4.0, 0.3, 6.0, 0.045) if way == "leaves" else (40.0, 2.0, 10.0, 0.0272)
    many = run(gudgeon, block(speed, -0.03, end, sideways, spin), "8 ms", every="0.1 ms", tolerance="1e-11")
    flat = run(gudgeon, flat_block(speed, -0.03, end, sideways, spin), "8 ms", every="0.1 ms", tolerance="1e-11")
    assert len(flat.contacts) >= 1 and len(many.contacts) == 2 * len(flat.contacts)
    for field in ("time", "impact_speed", "duration", "peak_force"):
        paired = np.sort(many.contacts[field].reshape(-1, 2), axis=1) * (2 if field == "peak_force" else 1)
        assert_close(paired, np.stack([flat.contacts[field]] * 2, axis=1), relative=1e-6, what=field)
    velocity = many.item("bodies/velocity", "block")
    assert_close(np.stack([velocity @ AXIS, velocity @ THIRD], axis=1), flat.item("bodies/velocity", "block"), absolute=1e-6, what="velocity")
    assert many.summary["energy_residual_max"] < 1e-6 * many.summary["energy_max"]
    # a guide without ends holds it longer
    endless = run(gudgeon, block(speed, 0.0, 0.0, sideways, spin), "8 ms", every="0.1 ms", tolerance="1e-11")
    assert not np.allclose(endless.item("bodies/velocity", "block")[-1], velocity[-1], atol=1e-3)


def test_pinball(gudgeon):
    """All of them in one deck: momentum of the click, the handle's speed, the stop that catches the plunger; the ledger closes."""
    directory = scratch()
    text = changed((ROOT / "inputs/pinball.deck").read_text(), "output", figures=None, every="0.25 ms")
    call(gudgeon, "run", written(directory, text), "--out", directory / "out", "--quiet")
    found = Run(directory / "out")
    speed = found.item("bodies/velocity", "plunger")[:, 1]
    assert_close(found.item("bodies/angular_velocity", "handle")[:, 2] * -0.012, speed, absolute=1e-7, what="rolling")
    items = [plain(row["item"]).strip() for row in found.contacts]
    assert {"push", "click", "end"} <= set(items)
    click = found.contacts[items.index("click")]
    before, after = (int(np.searchsorted(found.time, t)) for t in (click["time"], click["time"] + click["duration"]))
    momentum = 0.08 * found.item("bodies/velocity", "light") + 0.16 * found.item("bodies/velocity", "heavy")
    assert_close(momentum[after, :2], momentum[before - 1, :2], absolute=5e-3 * np.linalg.norm(momentum[before - 1]), what="momentum")
    assert found.summary["energy_residual_max"] < 1e-5 * found.summary["energy_max"]


def test_sliding_at_a_limit_that_is_not_there(gudgeon_debug):
    """A stop with one limit has a contact that never is: it slides at no speed, which is no 0/0 either."""
    text = (ROOT / "inputs" / "pinball.deck").read_text()
    directory = scratch()
    deck = written(directory, changed(changed(text, "output", channels="end.sliding_speed", every="1 ms", figures=None), "analysis.dynamic", end="2 ms"))
    call(gudgeon_debug, "run", deck, "--out", directory / "out", "--quiet")
    assert np.all(Run(directory / "out").read("clearances/contacts/sliding_speed") == 0)
