"""clearance.cam against discs, closed forms, a search of its own for the deepest place, and what a row may not say."""

import numpy as np
import pytest
from scipy.optimize import brentq, minimize_scalar
from support import ROOT, Run, assert_close, call, scratch, written

FRICTIONS = "[friction.coulomb]\nname coefficient\nstick 0.25\n[friction.ambrosio]\nname coefficient v0[m/s] v1[m/s]\nslip 0.1 1e-4 1e-3\n"
STEEL = "[material]\nname young[GPa] poisson\nsteel 207 0.3\n"


def run(program, text, end, every="1 ms", expect=0, tolerance="1e-10", **settings):
    """Run a deck given as text."""
    directory = scratch()
    more = "".join(f"{key} = {value}\n" for key, value in settings.items())
    text = f"deck = 1\n{text}\n[analysis.dynamic]\n{more}end = {end}\ntolerance = {tolerance}\n[output]\nevery = {every}\n"
    done = call(program, "run", written(directory, text), "--out", directory / "out", "--quiet", "--write", "channels", expect=expect)
    return Run(directory / "out", done) if expect == 0 else done


def two_bodies(joint, friction="none", law="[contact.lankarani_nikravesh]\nname restitution\nhard 0.8\n", more=""):
    """A disc flies at a body that turns; `joint` is their contact."""
    return f"""
[scene]
gravity = 0 -9.81 m/s^2
[bodies]
name mass[kg] inertia[kg.m^2] x[mm] y[mm] vx[m/s] vy[m/s] omega[rad/s]
cam 0.4 2e-4 0 0 0 0 15
ball 0.2 4e-5 6 60 0.1 -0.5 -20
[points]
name body xi[mm] eta[mm]
c cam 2 1
b ball 0 0
{STEEL}
{joint.format(friction=friction)}
{law}
{FRICTIONS}
{more}"""


DISCS = "[clearance.discs]\nname i j radius_i[mm] radius_j[mm] material law friction\nhit c b 30 20 steel hard {friction}\n"
CIRCLE = "[clearance.cam]\nname cam follower profile radius[mm] material law friction\nhit c b {profile} 20 steel hard {{friction}}\n"


@pytest.mark.parametrize("friction", ["none", "slip", "stick"])
def test_circle_is_a_disc(gudgeon, friction):
    """A profile of one radius is clearance.discs: motion, contacts and what they lose; compilers round the two differently."""
    discs = run(gudgeon, two_bodies(DISCS, friction), "30 ms")
    cam = run(gudgeon, two_bodies(CIRCLE.format(profile="30mm"), friction), "30 ms")
    assert len(discs.contacts) == len(cam.contacts) >= 1
    for name in ("time", "impact_speed", "peak_force", "duration", "impulse", "energy_lost"):
        assert_close(cam.contacts[name], discs.contacts[name], relative=1e-9, absolute=1e-13, what=name)
    for name in ("position", "velocity", "angular_velocity"):
        expected = discs.read(f"bodies/{name}")
        assert_close(cam.read(f"bodies/{name}"), expected, absolute=(1e-10 if friction == "slip" else 3e-12) * abs(expected).max(), what=name)


def test_circle_through_points(gudgeon):
    """Points on the circle, either way around: what the spline makes of them is right to the fourth order."""
    discs = run(gudgeon, two_bodies(DISCS), "30 ms")
    errors = []
    for n in (12, 24, 48):
        angle = 2 * np.pi * np.arange(n) / n * (-1 if n == 24 else 1) + 0.3
        x, y = ('"' + " ".join(f"{value:.15g}" for value in 30 * wave) + ' mm"' for wave in (np.cos(angle), np.sin(angle)))
        table = f"[clearance.cam]\nname cam follower x y radius[mm] material law friction\nhit c b {x} {y} 20 steel hard none\n"
        cam = run(gudgeon, two_bodies(table.replace("{", "{{")), "30 ms")
        errors.append(abs(cam.contacts["time"][0] - discs.contacts["time"][0]))
    assert errors[0] > 1e-9
    assert errors[1] < errors[0] / 10 and errors[2] < errors[1] / 10, errors


def test_points_in_a_file(gudgeon):
    """A file of points is the lists of the row, and the echo holds them."""
    directory = scratch()
    angle = np.radians(np.arange(0, 361, 10))
    rows = "".join(f"{28 * np.cos(a):.12g} {30 * np.sin(a):.12g}\n" for a in angle)
    (directory / "oval.txt").write_text("x[mm] y[mm]\n" + rows)
    joint = '[clearance.cam]\nname cam follower file radius[mm] material law\nhit c b "oval.txt" 20 steel hard\n'
    text = "deck = 1\n" + two_bodies(joint) + "[analysis.dynamic]\nend = 30 ms\n[output]\nevery = 1 ms\n"
    call(gudgeon, "run", written(directory, text), "--out", directory / "out", "--quiet", "--write", "channels")
    first = Run(directory / "out")
    call(gudgeon, "run", directory / "out" / "deck.echo", "--out", directory / "again", "--quiet", "--write", "channels")
    assert_close(Run(directory / "again").read("bodies/position"), first.read("bodies/position"), absolute=0.0)
    assert len(first.contacts) >= 1


# the follower of an eccentric cam

MASS, SPRING, PRELOAD, ROUND, ECCENTRIC, ROLLER = 0.5, 2000.0, 40.0, 0.03, 0.008, 0.012


def follower(contact, stiffness, omega, height, speed, damping=0.0):
    """An eccentric circle turns evenly about the origin; above it a follower in a guide, pressed down by a spring."""
    force = f"{{{stiffness:.17g} N/m*delta + {damping} N.s/m*rate}}"
    radius = ROLLER if contact == "roller" else 0.0
    return f"""
[scene]
gravity = 0 -9.81 m/s^2
[bodies]
name mass[kg] inertia[kg.m^2] x[m] y[m] vy[m/s] omega[rad/s]
cam 1 1e-3 0 0 0 {omega:.17g}
rod {MASS} 1e-3 0 {height:.17g} {speed:.17g} 0
[points]
name body xi[m] eta[m]
axle ground 0 0
hub cam 0 0
centre cam {ECCENTRIC} 0
foot rod 0 0
top ground 0 0.2
[joint.revolute]
name i j
bearing axle hub
[joint.translational]
name i j axis
guide axle foot y
[driver.speed]
name joint speed
motor bearing {omega:.17g}rad/s
[force.spring]
name i j stiffness[N/m] free_length[m] preload[N]
back foot top {SPRING} {0.2 - ROUND - radius:.17g} {-PRELOAD}
{STEEL}
[clearance.cam]
name cam follower profile contact radius[m] face_axis face_angle[deg] material law
lift centre foot {ROUND}m {contact} {radius} y 180 steel linear
[contact.expression]
name force
linear {force}
"""


def rigid_force(contact, omega, t):
    """Force of a rigid contact: the follower's equation along its guide."""
    s, c = ECCENTRIC * np.sin(omega * t), ECCENTRIC * np.cos(omega * t)
    if contact == "flat":
        lift, second, cosine = s, -(omega**2) * s, 1.0
    else:
        reach = ROUND + ROLLER
        root = np.sqrt(reach**2 - c**2)
        lift = s + root - reach
        slope = c * s / root * omega  # d root/dt
        second = -(omega**2) * s + omega**2 * (c**2 - s**2) / root - slope**2 / root
        cosine = root / reach
    return (MASS * (second + 9.81) + PRELOAD + SPRING * lift) / cosine


def test_force_of_a_flat_follower(gudgeon):
    """Linear contact: the stationary motion is a sine in closed form; its force tends to that of a rigid cam."""
    omega, forces = 40.0, []
    for stiffness in (1e7, 2e7, 4e7):
        whole = stiffness + SPRING
        mean = (stiffness * ROUND + SPRING * ROUND - PRELOAD - MASS * 9.81) / whole
        wave = stiffness * ECCENTRIC / (whole - MASS * omega**2)
        result = run(gudgeon, follower("flat", stiffness, omega, mean, wave * omega), "0.1 s", tolerance="1e-12", overlap="preload")
        t = result.time
        height = result.item("bodies/position", "rod")[:, 1]
        assert_close(height, mean + wave * np.sin(omega * t), absolute=1e-11, what="height")
        forces.append(result.read("clearances/contacts/normal_force").ravel())
        exact = stiffness * (ROUND + ECCENTRIC * np.sin(omega * t) - mean - wave * np.sin(omega * t))
        assert_close(forces[-1], exact, absolute=1e-5, what="force")
        assert abs(result.summary["energy_residual_max"]) < 1e-7
    line = [2 * forces[1] - forces[0], 2 * forces[2] - forces[1]]
    best = (4 * line[1] - line[0]) / 3
    expected = rigid_force("flat", omega, t)
    assert_close(best, expected, absolute=1e-6 * expected.max(), what="extrapolated force")


def test_force_of_a_roller_follower(gudgeon):
    """A damped linear contact follows the rigid lift up to terms of 1/K; extrapolated, the force is that of a rigid cam."""
    omega, forces = 30.0, []
    for stiffness in (2e6, 4e6, 8e6):
        height = np.sqrt((ROUND + ROLLER) ** 2 - ECCENTRIC**2) - 45.0 / stiffness
        text = follower("roller", stiffness, omega, height, ECCENTRIC * omega, damping=200.0)
        result = run(gudgeon, text, "0.4 s", tolerance="1e-12", overlap="preload")
        late = result.time > 0.2
        forces.append(result.read("clearances/contacts/normal_force").ravel()[late])
    line = [2 * forces[1] - forces[0], 2 * forces[2] - forces[1]]
    best = (4 * line[1] - line[0]) / 3
    expected = rigid_force("roller", omega, result.time[late])
    assert_close(best, expected, absolute=2e-6 * expected.max(), what="extrapolated force")


def test_speed_at_which_a_follower_leaves(gudgeon):
    """The cam's speed from which on the flat follower leaves, by bisection of runs, tends to that of the closed form."""
    found = []
    for stiffness in (1e6, 2e6, 4e6):

        def leaves(omega):
            whole = stiffness + SPRING
            mean = (whole * ROUND - PRELOAD - MASS * 9.81) / whole
            wave = stiffness * ECCENTRIC / (whole - MASS * omega**2)
            result = run(gudgeon, follower("flat", stiffness, omega, mean, wave * omega), f"{6.5 / omega:.6g} s", tolerance="1e-12", overlap="preload")
            return not np.isnan(result.contacts["duration"][0])

        low, high = 90.0, 140.0
        while high - low > 1e-7 * low:
            middle = 0.5 * (low + high)
            low, high = (low, middle) if leaves(middle) else (middle, high)
        found.append(0.5 * (low + high))
    line = [2 * found[1] - found[0], 2 * found[2] - found[1]]
    best = (4 * line[1] - line[0]) / 3
    expected = np.sqrt((PRELOAD + SPRING * ECCENTRIC + MASS * 9.81) / (MASS * ECCENTRIC))
    assert abs(found[0] / expected - 1) > 1e-4  # the contact yields
    assert_close(best, expected, relative=1e-6, what="speed")


# random profiles against a search of their own


def random_profile(seed):
    """Radius of a smooth closed profile and its derivatives, and the same for a deck."""
    random = np.random.default_rng(seed)
    orders = np.arange(1, 6)
    size = random.uniform(-1, 1, 5) * (0.09 if seed % 2 else 0.035) / orders**1.5
    phase = random.uniform(0, 2 * np.pi, 5)
    text = "{30mm*(1" + "".join(f" + {a:.15g}*cos({k}*angle + {p:.15g}rad)" for a, k, p in zip(size, orders, phase)) + ")}"

    def radius(u, derivative=0):
        total = 0.03 if derivative == 0 else 0.0
        for a, k, p in zip(size, orders, phase):
            total = total + 0.03 * a * k**derivative * np.cos(k * u + p + derivative * np.pi / 2)
        return total

    return text, radius


def nearest(radius, point):
    """Distance of a point from a profile, and the angle of the nearest place: by a dense scan and a bounded minimisation."""

    def distance(u):
        return np.hypot(point[0] - radius(u) * np.cos(u), point[1] - radius(u) * np.sin(u))

    grid = np.linspace(0, 2 * np.pi, 3001)
    u = grid[np.argmin(distance(grid))]
    best = minimize_scalar(distance, bounds=(u - 0.003, u + 0.003), method="bounded", options={"xatol": 1e-12})
    return best.fun, best.x


def curvature(radius, u):
    r, r1, r2 = radius(u), radius(u, 1), radius(u, 2)
    return (r**2 + 2 * r1**2 - r * r2) / (r**2 + r1**2) ** 1.5


@pytest.mark.parametrize("seed", range(12))
def test_random_profiles(gudgeon, seed):
    """A ball hops on a cam that turns: penetration, state and Hertz's force at every row as a search of its own has them; no energy is made."""
    profile, radius = random_profile(seed)
    law = "[contact.hertz]\nname\nhard\n" if seed % 3 else "[contact.lankarani_nikravesh]\nname restitution\nhard 0.8\n"
    ball = 0.008
    joint = f"[clearance.cam]\nname cam follower profile radius[m] material law\nhit c b {profile} {ball} steel hard\n"
    text = two_bodies(joint.replace("{", "{{").replace("}", "}}"), law=law)
    result = run(gudgeon, text, "60 ms", every="0.2 ms")
    rows = {name: result.rows(name) for name in ("bodies/position", "bodies/angle", "clearances/contacts/penetration", "clearances/contacts/state", "clearances/contacts/normal_force")}
    names = [str(name).strip() for name in result.read("bodies/names")]
    cam, other = names.index("cam"), names.index("ball")
    touched = 0
    for k in range(len(rows["bodies/position"])):
        angle = rows["bodies/angle"][k, cam]
        turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
        point = turn.T @ (rows["bodies/position"][k, other] - rows["bodies/position"][k, cam]) - [0.002, 0.001]
        distance, u = nearest(radius, point)
        delta = ball - distance
        assert_close(rows["clearances/contacts/penetration"][k].item(), max(delta, 0.0), absolute=1e-12, what="penetration")
        if abs(delta) > 1e-10:
            assert rows["clearances/contacts/state"][k].item() == (delta > 0)
        if delta > 1e-7 and seed % 3:
            touched += 1
            stiffness = 4 / (6 * (1 - 0.3**2) / 207e9) / np.sqrt(curvature(radius, u) + 1 / ball)
            assert_close(rows["clearances/contacts/normal_force"][k].item(), stiffness * delta**1.5, relative=1e-5, what="Hertz's force")
    assert len(result.contacts) >= 1 and (touched >= 1 or seed % 3 == 0)
    assert abs(result.summary["energy_residual_max"]) < 1e-9 * result.summary["energy_max"]


def test_first_impact(gudgeon):
    """The instant of the first contact against a root of the distance along the free flight."""
    for seed in (1, 4, 7):
        profile, radius = random_profile(seed)
        joint = f"[clearance.cam]\nname cam follower profile radius[m] material law\nhit c b {profile} 0.008 steel hard\n"
        result = run(gudgeon, two_bodies(joint.replace("{", "{{").replace("}", "}}")), "60 ms", tolerance="1e-12")

        def gap(t):
            turn = np.array([[np.cos(15 * t), -np.sin(15 * t)], [np.sin(15 * t), np.cos(15 * t)]])
            point = turn.T @ np.array([0.006 + 0.1 * t, 0.06 - 0.5 * t]) - [0.002, 0.001]  # both fall alike
            return nearest(radius, point)[0] - 0.008

        times = np.linspace(0, 0.06, 601)
        gaps = np.array([gap(t) for t in times])
        first = np.flatnonzero(gaps < 0)[0]
        root = brentq(gap, times[first - 1], times[first], xtol=1e-14)
        assert_close(result.contacts["time"][0], root, absolute=1e-11, what="first impact")


HEAD = "name cam follower {} law\nhit c b {} hard"


@pytest.mark.parametrize(
    ("columns", "cells", "what"),
    [
        ("radius[mm] material", "5 steel", "cam 'hit' has no profile"),
        ("profile radius[mm]", "30mm 5", "cam 'hit' has no material"),
        ("profile x y radius[mm] material", '30mm "1 2 3 4 mm" "1 2 3 4 mm" 5 steel', "the profile is given twice"),
        ("profile radius[mm] material", "{30mm*(1 + 0.3*cos(3*angle))} 20 steel", "is too large for the hollow"),
        ("profile contact material", "{30mm*(1 + 0.3*cos(3*angle))} flat steel", "where a flat face would touch at two places"),
        ("profile radius[mm] material", "{30mm + 1mm/rad*angle} 5 steel", "the profile does not close"),
        ("profile radius[mm] material", "{30mm*cos(angle)} 5 steel", "the radius of the profile is"),
        ("profile radius[mm] material", "{30mm*log(angle)} 5 steel", "the radius of the profile is not finite at 0 deg"),
        ("profile radius[mm] material", "{30mm*sqrt(1 - angle/2rad)} 5 steel", "the radius of the profile is not finite at 115 deg"),
        ("profile contact radius[mm] material", "30mm flat 5 steel", "a flat face has no radius"),
        ("x radius[mm] material", '"1 2 3 4 mm" 5 steel', "the points have one coordinate"),
        ("x y radius[mm] material", '"10 0 -10 mm" "0 10 0 mm" 5 steel', "a smooth curve needs at least 4"),
        ("x y radius[mm] material", '"10 0 -10 0 mm" "0 10 0 N" 5 steel', "is not a length"),
        ("x y radius[mm] material", '"10 10 0 -10 0 mm" "0 0 10 0 -10 mm" 5 steel', "points 1 and 2 coincide"),
        ("x y radius[mm] material", '"10 0 -10 0 mm" "0 10 0 -10 mm" 5 steel', None),
        ("x y radius[mm] material", '"10 -10 10 -10 mm" "10 10 -10 -10 mm" 5 steel', "crosses itself"),
        ("profile radius[mm] material", "30mm 0 steel", "law 'hard'"),
    ],
)
def test_mistakes(gudgeon, columns, cells, what):
    """Rows that cannot be, named with their line and column; the last column of points is well-formed."""
    joint = f"[clearance.cam]\nname cam follower {columns} law\nhit c b {cells} hard\n"
    text = two_bodies(joint.replace("{", "{{").replace("}", "}}"))
    if what is None:
        run(gudgeon, text, "1 ms")
        return
    done = run(gudgeon, text, "1 ms", expect=3)
    assert what in done.stderr, done.stderr
    assert "scene.deck:" in done.stderr and "^" in done.stderr


def test_overlap_at_the_start(gudgeon):
    """A roller that starts deep in its cam is an error that names it."""
    text = two_bodies(CIRCLE.format(profile="30mm")).replace("ball 0.2 4e-5 6 60", "ball 0.2 4e-5 6 20").format()
    done = run(gudgeon, text, "1 ms", expect=(0, 3, 4))
    words = done.stderr + done.stdout if not isinstance(done, Run) else done.done.stderr + done.done.stdout
    assert "hit" in words


def test_in_space_it_is_refused(gudgeon):
    """Scenes of space do not know it, and say so."""
    text = two_bodies(CIRCLE.format(profile="30mm")).replace("[scene]\n", "[scene]\nspace = spatial\n", 1)
    done = run(gudgeon, text, "1 ms", expect=3)
    assert "clearance.cam" in done.stderr


@pytest.mark.parametrize("deck", ["cam_follower", "scotch_yoke"])
def test_decks_restart(gudgeon, deck):
    """A checkpoint within a contact, whose law has the stiffness of its place, is continued to the bit."""
    call(gudgeon, "run", ROOT / f"inputs/{deck}.deck", "--verify-restart", "--quiet", "--write", "channels", "--out", scratch() / "out")


def test_sensitivity(gudgeon):
    """Derivatives by the base radius through impacts (`gudgeon sensitivity`) against differences of runs."""
    text = (ROOT / "inputs/cam_follower.deck").read_text().replace("500 rpm", "1200 rpm").replace("{base + roller}   0\n", "33.1 0\n")
    text = text.replace("end         = 1 turns of motor", "end         = 30 ms").replace("tolerance   = 1e-9", "tolerance   = 1e-11")
    text += "\n[sensitivity]\nparameters = base\nresults = contact.onset(2) contact.impact_speed(2) contact.onset(3)\n"
    directory = scratch()
    call(gudgeon, "sensitivity", written(directory, text), "--out", directory / "out", "--quiet")
    found = [row.split(",") for row in (directory / "out/sensitivity.csv").read_text().splitlines()]
    events = []
    for base in (24.999, 25.001):
        call(gudgeon, "run", directory / "scene.deck", "--set", f"base={base}mm", "--out", directory / f"{base}", "--quiet", "--write", "channels")
        events.append(Run(directory / f"{base}").contacts)
    for name, place in (("onset(2)", 1), ("impact_speed(2)", 1), ("onset(3)", 2)):
        column = "time" if name.startswith("onset") else "impact_speed"
        slope = (events[1][column][place] - events[0][column][place]) / 2e-6
        (derivative,) = [float(row[2]) for row in found if row[:2] == [f"contact.{name}", "base"]]
        assert_close(derivative, slope, relative=1e-4, what=name)


def test_profile_is_drawn(gudgeon):
    """The picture of a cam has its outline: places at the base radius and at the full lift."""
    directory = scratch()
    call(gudgeon, "run", ROOT / "inputs/cam_follower.deck", "--out", directory / "out", "--quiet")
    numbers = []
    for line in (directory / "out/figures/strip.n.6.dat").read_text().splitlines():
        words = line.split()
        if len(words) >= 2 and not line.startswith("#"):
            numbers.append([float(word) for word in words[:2]])
    radii = np.hypot(*np.array(numbers).T)
    scale = 1e3 if radii.max() > 1 else 1.0
    assert (abs(radii - 0.025 * scale) < 1e-5 * scale).sum() > 100 and (abs(radii - 0.033 * scale) < 1e-5 * scale).sum() > 20
