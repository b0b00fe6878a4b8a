"""Closed spatial loops whose numbers have the digits that people give: assembled, with the motion of the exact loop, or refused with
the joint that is off and by how much."""

import math
import re

import numpy as np
from support import Run, call, scratch, written

KINDS = ("four_bar", "spherical", "bennett", "universal", "rssr")
EACH = 40  # loops of a kind in the full set: 200 in all
DIGITS = range(3, 9)
EXACT = 17  # digits
TURN = 0.2  # of the crank in a run [rad]


def rotation(axis, angle):
    """A rotation about an axis."""
    x, y, z = axis / np.linalg.norm(axis)
    k = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + math.sin(angle) * k + (1 - math.cos(angle)) * k @ k


def unit(rng):
    """A random direction."""
    x = rng.normal(size=3)
    return x / np.linalg.norm(x)


def step(theta, length, twist):
    """From a joint of a loop to the next, after Denavit and Hartenberg."""
    t = np.eye(4)
    t[:3, :3] = rotation(np.array([0.0, 0, 1]), theta)
    m = np.eye(4)
    m[0, 3] = length
    m[:3, :3] = rotation(np.array([1.0, 0, 0]), twist)
    return t @ m


class Loop:
    """Joints of a loop: kind, place and axis of each; body k lies between joints k - 1 and k, body 0 is the ground."""

    def __init__(self, kind, seed):
        self.kind, self.rng = kind, np.random.default_rng([KINDS.index(kind), seed])
        self.joints = getattr(self, kind)()
        size, turn, shift = 10.0 ** self.rng.uniform(-1.5, 0.5), rotation(unit(self.rng), self.rng.uniform(0, 3)), self.rng.normal(size=3)
        self.joints = [(k, size * (turn @ p + shift), turn @ a) for k, p, a in self.joints]
        self.size = size
        self.turned = [(unit(self.rng), self.rng.uniform(0.1, 2.5)) for _ in self.joints[1:]]

    def four_bar(self):
        """Four parallel axes."""
        crank, rod, rocker, base = 0.3, 0.9, 0.7, 1.0
        theta = self.rng.uniform(0.5, 2.5)
        a = np.array([0.0, 0, 0])
        b = crank * np.array([math.cos(theta), math.sin(theta), 0])
        d = np.array([base, 0, 0])
        gap = np.linalg.norm(d - b)
        along = (rod**2 - rocker**2 + gap**2) / (2 * gap)
        e = (d - b) / gap
        c = b + along * e + math.sqrt(rod**2 - along**2) * np.array([-e[1], e[0], 0])
        z = np.array([0.0, 0, 1])
        return [("revolute", p, z) for p in (a, b, c, d)]

    def spherical(self):
        """Four axes through a point."""
        arcs = (0.4, 1.1, 0.9, 1.2)
        theta = self.rng.uniform(0.6, 2.4)
        z1 = np.array([0.0, 0, 1])
        z4 = rotation(np.array([1.0, 0, 0]), arcs[3]) @ z1
        z2 = rotation(z1, theta) @ rotation(np.array([1.0, 0, 0]), arcs[0]) @ z1
        c2, c4, c24 = math.cos(arcs[1]), math.cos(arcs[2]), z2 @ z4
        x, y = np.linalg.solve([[1, c24], [c24, 1]], [c2, c4])
        n = np.cross(z2, z4)
        z3 = x * z2 + y * z4 + math.sqrt((1 - x * x - y * y - 2 * x * y * c24) / (n @ n)) * n
        return [("revolute", z * self.rng.uniform(0.5, 1.0), z) for z in (z1, z2, z3, z4)]

    def bennett(self):
        """Bennett's linkage: opposite links alike, sines of the twists as the lengths."""
        a, alpha, beta = 1.0, self.rng.uniform(0.4, 0.9), self.rng.uniform(1.1, 1.5)
        b = a * math.sin(beta) / math.sin(alpha)
        t1 = self.rng.uniform(0.6, 2.2)
        t2 = 2 * math.atan(math.sin((beta + alpha) / 2) / math.sin((beta - alpha) / 2) / math.tan(t1 / 2))
        frames, t = [np.eye(4)], np.eye(4)
        for theta, (length, twist) in zip((t1, t2, -t1, -t2), ((a, alpha), (b, beta), (a, alpha), (b, beta))):
            t = t @ step(theta, length, twist)
            frames.append(t)
        assert np.allclose(t, np.eye(4), atol=1e-9) or np.allclose(t[:3, 3], 0, atol=1e-9), t
        return [("revolute", f[:3, 3], f[:3, 2]) for f in frames[:4]]

    def universal(self):
        """Two shafts and a universal joint where their axes meet."""
        bend = self.rng.uniform(0.2, 0.9)
        z, other = np.array([0.0, 0, 1]), np.array([0, math.sin(bend), math.cos(bend)])
        return [("revolute", -z, z), ("universal", np.zeros(3), np.array([1.0, 0, 0])), ("revolute", other, other)]

    def rssr(self):
        """Crank, rod between balls, rocker: no row is redundant."""
        theta = self.rng.uniform(0.5, 2.5)
        a, b = np.zeros(3), np.array([0.1 * math.cos(theta), 0.1 * math.sin(theta), 0.0])
        d, reach = np.array([1.0, 0.3, 0.4]), 0.0
        while reach < 0.5:  # the rod is far from a dead centre of the rocker
            axis = unit(self.rng)
            c = d + 0.6 * (turn := np.cross(axis, unit(self.rng))) / np.linalg.norm(turn)
            reach = abs(np.cross(axis, c - d) @ (c - b)) / (0.6 * np.linalg.norm(c - b))
        return [("revolute", a, np.array([0.0, 0, 1])), ("spherical", b, axis), ("spherical", c, axis), ("revolute", d, axis)]

    def text(self, digits, fault=None):
        """The deck, its numbers rounded; `fault` turns the axis of the last joint, in body or ground, by an angle [rad]."""
        number = lambda x: f"{float(x):.{digits}g}"
        row = lambda x: " ".join(number(v) for v in x)
        n = len(self.joints)
        lines = ["deck = 1", "[scene]", "space = spatial", "gravity = 0 0 -9.81 m/s^2", "[bodies]"]
        lines.append("name mass[kg] ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2] x[m] y[m] z[m] axis angle[rad]")
        inertia = number(0.1 * self.size**2)
        points, tables = [], {"revolute": [], "universal": [], "spherical": []}
        frame = {0: (np.zeros(3), np.eye(3))}
        for k in range(1, n):
            centre = 0.5 * (self.joints[k - 1][1] + self.joints[k][1])
            axis, angle = self.turned[k - 1]
            frame[k] = (centre, rotation(axis, angle))
            lines.append(f'b{k} 1 {inertia} {inertia} {inertia} {row(centre)} "{row(axis)}" {number(angle)}')
        for k, (kind, place, axis) in enumerate(self.joints):
            i, j = k, (k + 1) % n
            for body, side in ((i, "i"), (j, "j")):
                centre, turn = frame[body]
                points.append(f"p{k}{side} {f'b{body}' if body else 'ground'} {row(turn.T @ (place - centre))}")
            ends = [frame[i][1].T @ axis, frame[j][1].T @ axis]
            if fault and k == n - 1:
                ends[1] = rotation(np.cross(ends[1], [0.3, 0.5, 0.7]), fault) @ ends[1]
            if kind == "universal":
                ends[1] = frame[j][1].T @ np.cross(self.joints[k + 1][2], axis)
            if kind == "spherical":
                tables[kind].append(f"j{k} p{k}i p{k}j")
            else:
                tables[kind].append(f'j{k} p{k}i p{k}j "{row(ends[0])}" "{row(ends[1])}"')
        lines += ["[points]", "name body xi[m] eta[m] zeta[m]", *points]
        for kind, rows in tables.items():
            if rows:
                lines += [f"[joint.{kind}]", "name i j" + ("" if kind == "spherical" else " axis_i axis_j"), *rows]
        lines += ["[driver.speed]", "name joint speed", "motor j0 1rad/s", "[analysis.dynamic]", f"end = {TURN} s"]
        lines += ["[output]", f"every = {TURN / 4} s", "channels = *", ""]
        return "\n".join(lines)

    def run(self, program, digits, directory, **options):
        """Run it: what the program said, and the places of the bodies if it did."""
        deck = written(directory, self.text(digits, **options))
        done = call(program, "run", deck, "--out", directory / "out", "--write", "channels", expect=None, limit=60)
        places = Run(directory / "out", done).read("bodies/position") if done.returncode == 0 else None
        return done, places


def mistakes_of(program, kind, seed):
    """What is wrong with a rounded loop, in words."""
    loop, digits = Loop(kind, seed), DIGITS[seed % len(DIGITS)]
    exact, places = loop.run(program, EXACT, scratch())
    if places is None:
        return [f"the exact loop: {exact.stderr.strip().splitlines()[0]}"]
    done, rounded = loop.run(program, digits, scratch())
    said = done.stdout + done.stderr
    if rounded is None:
        is_named = re.search(r"'j\d' is off by [0-9.e+-]+ mm", said)
        return [] if done.returncode == 4 and is_named and digits <= 3 else [f"exit code {done.returncode}: {said[-700:]}"]
    off = np.abs(rounded - places).max() / loop.size
    wrong = [] if off <= 300.0 * 10.0**-digits else [f"a body is {off:.1e} sizes off"]
    if kind != "rssr" and digits < 8 and "is off by" not in said and "but for the deck's digits" not in said:
        wrong.append("no warning of the misfit")
    return wrong


def wrong_scenes(program, each=EACH):
    """Lines about rounded loops that went wrong; says how many there were."""
    wrong = [f"{k} {n}: {'; '.join(m)}" for k in KINDS for n in range(each) if (m := mistakes_of(program, k, n))]
    print(f"{each * len(KINDS)} rounded loops, {len(wrong)} mistakes")
    return wrong
