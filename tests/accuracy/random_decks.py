"""Random mechanisms for the certification of `gudgeon run --accuracy`: chains, loops, springs, loose joints, friction.

Every deck follows from its number alone. Scenes whose contacts begin together are those of tests/stability/random_scenes.py.
"""

import dataclasses
import math
import pathlib
import sys

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent / "stability"), str(HERE.parent / "e2e")]
from random_scenes import KINDS, draw  # noqa: E402
from support import changed  # noqa: E402

INSTANTS = 100  # output intervals of a motion
LAWS = ("lankarani_nikravesh", "hunt_crossley", "flores", "hertz")


@dataclasses.dataclass(frozen=True)
class Deck:
    """A deck and the accuracy that is asked of it."""

    label: str
    text: str
    accuracy: float


class Dice:
    """Random numbers as decks want them."""

    def __init__(self, seed):
        self.rng = np.random.default_rng(seed)

    def number(self, low, high):
        """A number of four figures."""
        return float(f"{self.rng.uniform(low, high):.4g}")

    def power(self, low, high):
        """Ten to the power of a number."""
        return float(f"{10.0**self.rng.uniform(low, high):.3g}")

    def count(self, low, high):
        """An integer, both ends included."""
        return int(self.rng.integers(low, high + 1))

    def choice(self, words):
        """One of some words."""
        return words[int(self.rng.integers(len(words)))]


def table(section, columns, rows):
    """One table of a deck."""
    return f"[{section}]\n{columns}\n" + "".join(" ".join(map(str, row)) + "\n" for row in rows)


def ends(seconds, channels=""):
    """The sections that every deck has."""
    return f"[analysis.dynamic]\nend = {seconds} s\n[output]\nevery = {seconds/INSTANTS!r} s\n" + (channels and f"channels = {channels}\n")


def rods(joints, masses):
    """Uniform rods from joint to joint: rows of bodies and of points (aK and bK at the ends of rod K)."""
    bodies, points = [], []
    for k, (p, q) in enumerate(zip(joints, joints[1:])):
        length = math.dist(p, q)
        angle = math.atan2(q[1] - p[1], q[0] - p[0])
        bodies.append((f"rod{k}", masses[k], masses[k]*length**2/12.0, 0.5*(p[0] + q[0]), 0.5*(p[1] + q[1]), angle))
        points += [(f"a{k}", f"rod{k}", -0.5*length, 0), (f"b{k}", f"rod{k}", 0.5*length, 0)]
    return bodies, points


BODIES = "name mass[kg] inertia[kg.m^2] x[m] y[m] angle[rad]"
POINTS = "name body xi[m] eta[m]"
GRAVITY = "deck = 1\n[scene]\ngravity = 0 -9.81 m/s^2\n"


def chain(dice):
    """Pendulums one on the other, with springs and dampers in some of the joints, and friction in some."""
    n = dice.count(1, 4)
    joints = [(0.0, 0.0)]
    for _ in range(n):
        length, angle = dice.number(0.1, 0.5), dice.number(-math.pi, math.pi)
        joints.append((joints[-1][0] + length*math.cos(angle), joints[-1][1] + length*math.sin(angle)))
    bodies, points = rods(joints, [dice.number(0.2, 3.0) for _ in range(n)])
    points.append(("hook", "ground", 0, 0))
    rubs = dice.rng.random() < 0.4
    pins = [(f"pin{k}", "hook" if k == 0 else f"b{k - 1}", f"a{k}", "rub" if rubs and k == 0 else "none", "10") for k in range(n)]
    text = GRAVITY + table("bodies", BODIES, bodies) + table("points", POINTS, points)
    if rubs:
        text += table("friction.brown_mcphee", "name coefficient static_coefficient v_t[mm/s]",
                      [("rub", 0.2, 0.3, dice.number(5.0, 50.0))])
    text += table("joint.revolute", "name i j friction radius[mm]", pins)
    springs = [(f"coil{k}", f"rod{k - 1}", f"rod{k}", dice.power(-1.0, 1.5), dice.choice((0, dice.power(-3.0, -1.0))))
               for k in range(1, n) if dice.rng.random() < 0.6]
    if springs:
        text += table("force.torsion_spring", "name i j stiffness[N.m/rad] damping[N.m.s/rad]", springs)
    return text + ends(dice.number(0.5, 2.0))


def loop(dice):
    """A four-bar that its crank drives, or that turns freely from a speed at the start, with a spring across it."""
    ground = dice.number(0.3, 0.5)
    crank = dice.number(0.05, 0.12)
    coupler = ground*dice.number(0.9, 1.3)
    rocker = ground*dice.number(0.8, 1.1)
    angle = dice.number(0.3, 2.8)
    elbow = (crank*math.cos(angle), crank*math.sin(angle))
    far = math.dist(elbow, (ground, 0.0))
    turn = math.acos((coupler**2 + far**2 - rocker**2)/(2.0*coupler*far))
    turn += math.atan2(-elbow[1], ground - elbow[0])
    top = (elbow[0] + coupler*math.cos(turn), elbow[1] + coupler*math.sin(turn))
    bodies, points = rods([(0.0, 0.0), elbow, top, (ground, 0.0)], [dice.number(0.2, 2.0) for _ in range(3)])
    points += [("left", "ground", 0, 0), ("right", "ground", ground, 0), ("far", "ground", dice.number(-0.5, 1.0), dice.number(-0.5, 1.0))]
    text = GRAVITY + table("bodies", BODIES, bodies) + table("points", POINTS, points)
    text += table("joint.revolute", "name i j", [("p0", "left", "a0"), ("p1", "b0", "a1"), ("p2", "b1", "a2"), ("p3", "right", "b2")])
    speed = dice.number(5.0, 40.0)
    if dice.rng.random() < 0.5:
        text += table("driver.speed", "name joint speed[rad/s]", [("motor", "p0", speed)])
    else:
        text += table("initial.speed", "name joint speed[rad/s]", [("kick", "p0", speed)])
    if dice.rng.random() < 0.7:
        text += table("force.spring", "name i j stiffness[N/m] damping[N.s/m] free_length[m]",
                      [("coil", "far", "b1", dice.power(1.0, 3.0), dice.choice((0, dice.power(-1.0, 1.0))), dice.number(0.1, 0.5))])
    return text + ends(dice.number(0.3, 1.5), dice.choice(("", "*.position *.velocity *.force energy.*")))


def springs(dice):
    """Free bodies on springs and dampers, to the ground and to each other."""
    n = dice.count(1, 3)
    bodies, points, coils = [], [("o", "ground", 0, 0)], []
    for k in range(n):
        mass = dice.number(0.2, 3.0)
        bodies.append((f"b{k}", mass, mass*0.01*dice.number(0.3, 1.0), dice.number(-0.5, 0.5), -0.4*(k + 1), dice.number(-1.0, 1.0)))
        points += [(f"l{k}", f"b{k}", -0.1, 0), (f"r{k}", f"b{k}", 0.1, dice.number(-0.05, 0.05))]
    for k in range(n):
        other = "o" if k == 0 else f"r{k - 1}"
        for side in "lr"[:dice.count(1, 2)]:
            coils.append((f"coil{side}{k}", other, f"{side}{k}", dice.power(1.5, 3.5), dice.choice((0, dice.power(-1.0, 1.0))), dice.number(0.1, 0.3)))
    return (GRAVITY + table("bodies", BODIES, bodies) + table("points", POINTS, points) +
            table("force.spring", "name i j stiffness[N/m] damping[N.s/m] free_length[m]", coils) + ends(dice.number(0.3, 2.0)))


def loose(dice):
    """A slider-crank with a loose gudgeon pin, its guide with friction or not."""
    crank = dice.number(0.03, 0.08)
    rod = crank*dice.number(2.2, 4.0)
    text = "deck = 1\n[scene]\ngravity = 0 0 m/s^2\n"
    text += table("bodies", BODIES, [("crank", 0.3, 1e-4, 0.5*crank, 0, 0), ("rod", dice.number(0.1, 0.4), 2.5e-4, crank + 0.5*rod, 0, 0),
                                     ("slider", dice.number(0.1, 0.4), 1e-4, crank + rod, 0, 0)])
    text += table("points", POINTS, [("main", "ground", 0, 0), ("heel", "crank", -0.5*crank, 0), ("throw", "crank", 0.5*crank, 0),
                                     ("big", "rod", -0.5*rod, 0), ("small", "rod", 0.5*rod, 0), ("pin", "slider", 0, 0)])
    text += table("joint.revolute", "name i j", [("main", "main", "heel"), ("big_end", "throw", "big")])
    text += table("joint.translational", "name i j axis", [("guide", "main", "pin", "x")])
    speed = dice.number(50.0, 500.0)
    text += table("driver.speed", "name joint speed[rad/s]", [("motor", "main", speed)])
    text += table("material", "name young[GPa] poisson", [("steel", 207, 0.3)])
    law, rubs = dice.choice(LAWS), dice.rng.random() < 0.4
    if rubs:
        text += table("friction.brown_mcphee", "name coefficient static_coefficient v_t[mm/s]", [("rub", 0.1, 0.1, dice.number(20.0, 100.0))])
    text += table(f"contact.{law}", "name" + ("" if law == "hertz" else " restitution"),
                  [("law",) if law == "hertz" else ("law", dice.number(0.4, 0.95))])
    text += table("clearance.revolute", "name bearing journal bearing_radius[mm] clearance[mm] material law friction",
                  [("gudgeon", "pin", "small", 10, dice.number(0.05, 0.5), "steel", "law", "rub" if rubs else "none")])
    turns = dice.number(0.2, 0.8)
    return text + ends(float(f"{2.0*math.pi*turns/speed:.4g}"), dice.choice(("", "slider.* motor.moment gudgeon.force gudgeon.normal_force")))


def rubbing(dice):
    """A block that a spring pulls over a guide with friction, driven at its other end."""
    mass = dice.number(0.2, 3.0)
    text = GRAVITY + table("bodies", BODIES, [("block", mass, 0.01*mass, dice.number(-0.1, 0.1), 0, 0)])
    text += table("points", POINTS, [("rail", "ground", 0, 0), ("end", "ground", 0.5, 0), ("eye", "block", 0, 0)])
    text += table("friction.brown_mcphee", "name coefficient static_coefficient v_t[mm/s]", [("rub", dice.number(0.05, 0.3), 0.4, dice.number(5.0, 50.0))])
    text += table("joint.translational", "name i j axis friction", [("guide", "rail", "eye", "x", "rub")])
    text += table("force.spring", "name i j stiffness[N/m] free_length[m] actuator[N]",
                  [("coil", "end", "eye", dice.power(1.5, 3.0), 0.3, f"{{{dice.number(1.0, 10.0)}N*sin({dice.number(2.0, 20.0)}rad/s*t)}}")])
    return text + ends(dice.number(0.5, 2.0))


def falls(dice):
    """A scene of tests/stability whose contacts begin together, with all that it reports."""
    scene = draw(dice.choice(KINDS[:4]), dice.count(1000, 9999))
    text = changed(scene.text, "output", channels=dice.choice((None, "p.* *.normal_force energy.kinetic")), every=f"{scene.end/INSTANTS!r} s")
    return text


SPACE = "deck = 1\n[scene]\nspace = spatial\ngravity = 0 0 -9.81 m/s^2\n"
SOLIDS = "name mass[kg] ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2] x[m] y[m] z[m] wx[rad/s] wy[rad/s] wz[rad/s]"
PLACES = "name body xi[m] eta[m] zeta[m]"


def solid(dice, name, place, spin):
    """A row of a body with three moments of inertia that a body can have, turning at the start."""
    mass = dice.number(0.2, 3.0)
    squares = [dice.number(0.002, 0.02) for _ in range(3)]
    moments = [f"{mass*(sum(squares) - square):.4g}" for square in squares]
    return (name, mass, *moments, *place, *(dice.number(-spin, spin) for _ in range(3)))


def solids_on_springs(dice):
    """Free bodies in space on springs and dampers, to the ground and to each other."""
    n = dice.count(1, 3)
    bodies, points, coils = [], [("o", "ground", 0, 0, 0)], []
    for k in range(n):
        bodies.append(solid(dice, f"b{k}", (dice.number(-0.3, 0.3), dice.number(-0.3, 0.3), -0.4*(k + 1)), 5.0))
        points += [(f"{end}{k}", f"b{k}", *(dice.number(-0.15, 0.15) for _ in range(3))) for end in "lr"]
        for end in "lr"[:dice.count(1, 2)]:
            coils.append((f"coil{end}{k}", "o" if k == 0 else f"r{k - 1}", f"{end}{k}", dice.power(1.5, 3.0), dice.choice((0, dice.power(-1.0, 1.0))),
                          dice.number(0.1, 0.3)))
    return (SPACE + table("bodies", SOLIDS, bodies) + table("points", PLACES, points) +
            table("force.spring", "name i j stiffness[N/m] damping[N.s/m] free_length[m]", coils) + ends(dice.number(0.3, 1.5), dice.choice(("", "*"))))


def hung_solids(dice, is_loose=False):
    """Bodies in space that hang on ball joints one on the other, the first one in a socket with clearance or not."""
    n = dice.count(1, 3)
    bodies, points, place = [], [("o", "ground", 0, 0, 0)], (0.0, 0.0, 0.0)
    for k in range(n):
        arm = [dice.number(-0.3, 0.3), dice.number(-0.3, 0.3), dice.number(-0.3, -0.1)]
        bodies.append(solid(dice, f"b{k}", tuple(x + a for x, a in zip(place, arm)), 0.0))
        points += [(f"t{k}", f"b{k}", *(-a for a in arm)), (f"d{k}", f"b{k}", *arm)]
        place = tuple(x + 2.0*a for x, a in zip(place, arm))
    joints = [(f"ball{k}", "o" if k == 0 else f"d{k - 1}", f"t{k}") for k in range(1 if is_loose else 0, n)]
    text = SPACE + table("bodies", SOLIDS, bodies) + table("points", PLACES, points)
    if joints:
        text += table("joint.spherical", "name i j", joints)
    if is_loose:
        law = dice.choice(LAWS)
        text += table("material", "name young[GPa] poisson", [("steel", 207, 0.3)])
        text += table(f"contact.{law}", "name" + ("" if law == "hertz" else " restitution"),
                      [("law",) if law == "hertz" else ("law", dice.number(0.4, 0.95))])
        text += table("clearance.spherical", "name bearing journal bearing_radius[mm] clearance[mm] material law",
                      [("socket", "o", "t0", 10, dice.number(0.05, 0.5), "steel", "law")])
    return text + ends(dice.number(0.02, 0.08) if is_loose else dice.number(0.3, 1.5))


def loose_solids(dice):
    """The same with a socket that is loose."""
    return hung_solids(dice, True)


FAMILIES = (chain, loop, springs, loose, rubbing, falls)
IN_SPACE = (solids_on_springs, hung_solids, loose_solids)


def make(number, seed=1, families=FAMILIES):
    """Deck `number` of a seed."""
    dice = Dice([seed, number])
    family = families[number % len(families)]
    text = family(dice)
    return Deck(f"{family.__name__} {number}", text, dice.power(-8.0, -3.0))
