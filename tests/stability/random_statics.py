"""Random scenes without weight, and whether what is found at rest is an equilibrium: forces summed from formulas of springs and from
the forces that contacts and films report, each in proportion to the sum of their magnitudes."""

import math

import numpy as np
from support import Run, call, scratch, written

KINDS = ("net", "free_lengths", "rail", "disc", "pin", "film", "space", "socket")
EACH = 25  # scenes of a kind in the full set: 200 in all
ENOUGH = 1e-10  # residual, of the forces that act
ROUNDINGS = 10.0  # of stiffness times length, where they vanish
EPS = np.finfo(float).eps
STEEL = "[material]\nname young[GPa] poisson density[kg/m^3]\nsteel 207 0.3 7850\n[contact.hertz]\nname\nhertz\n"


class Scene:
    """A scene: its deck, and the springs and loads that a residual is summed from."""

    def __init__(self, kind, seed):
        self.kind, self.rng = kind, np.random.default_rng([KINDS.index(kind), seed])
        self.space = kind in ("space", "socket")
        self.size = 10.0 ** self.rng.uniform(-2, 0.5)  # m
        self.stiffness = 10.0 ** self.rng.uniform(2, 6)  # N/m
        self.bodies, self.points, self.springs, self.loads, self.others = [], {}, [], [], ""
        self.joints, self.through = [], []  # (channel, body, sign) of forces through the centre of a body
        getattr(self, "draw_" + kind)()

    def vector(self, scale=1.0):
        """A random vector, in the plane or in space."""
        x = np.zeros(3)
        n = 3 if self.space else 2
        x[:n] = self.rng.normal(size=n) * scale
        return x

    def point(self, body, place):
        """A new point of a body (-1: ground), by its place in the body's frame."""
        name = f"p{len(self.points)}"
        self.points[name] = (body, place)
        return name

    def spring(self, body, other, start, pull=0.3):
        """A spring between random points of two bodies that are where the lists says; its free length is off by a part."""
        a, b = self.vector(0.5 * self.size), self.vector(2.0 * self.size) if other < 0 else self.vector(0.5 * self.size)
        length = np.linalg.norm(start[body] + a - b - (start[other] if other >= 0 else 0.0))
        free = length * max(0.2, 1.0 + pull * self.rng.normal())
        k = self.stiffness * 10.0 ** self.rng.uniform(-0.5, 0.5)
        self.springs.append((self.point(body, a), self.point(other, b), k, free))

    def places(self, n, spread=1.0):
        """Random places of the bodies, all unturned."""
        return [self.vector(spread * self.size) for _ in range(n)]

    def draw_net(self, n=None):
        """Bodies in a net of springs, loads on some."""
        n = n or int(self.rng.integers(1, 4))
        self.bodies = self.places(n)
        for body in range(n):
            for _ in range(6 if self.space else 4):
                self.spring(body, -1, self.bodies)
            if body:
                self.spring(body, body - 1, self.bodies)
        if self.rng.random() < 0.6:
            for body in range(n):
                place = self.vector(0.3 * self.size)
                self.loads.append((self.point(body, place), self.vector(0.2 * self.stiffness * self.size)))

    def draw_space(self):
        """A net in space."""
        self.draw_net()

    def draw_free_lengths(self):
        """Springs at their free lengths somewhere near the start: all forces vanish at the equilibrium."""
        self.bodies = self.places(1)
        for _ in range(4):
            self.spring(0, -1, self.bodies, pull=0.0)
        self.bodies = [self.bodies[0] + self.vector(0.02 * self.size)]

    def draw_rail(self):
        """A body on a rail: springs across it, which the rail bears."""
        self.bodies = [np.array([0.0, 0.3 * self.size, 0.0])]
        for _ in range(3):
            self.spring(0, -1, self.bodies)
        self.rail = [self.point(-1, np.zeros(3)), self.point(0, np.zeros(3))]
        self.joints.append(f"[joint.translational]\nname i j axis\nrail {self.rail[0]} {self.rail[1]} y\n")

    def draw_disc(self):
        """A disc that springs press on a plane."""
        radius = 0.5 * self.size
        self.bodies = [np.array([0.0, radius, 0.0])]
        centre, floor = self.point(0, np.zeros(3)), self.point(-1, np.zeros(3))
        for x in (-0.8, 0.9):
            a, b = self.point(0, np.array([0.2 * x, 0.1, 0.0]) * self.size), self.point(-1, np.array([x, -0.7, 0.0]) * self.size)
            self.springs.append((a, b, self.stiffness, 0.5 * self.size * self.rng.uniform(0.3, 1.0)))
        self.others = (
            "[clearance.plane]\nname plane ball axis radius[m] material law\n"
            f"touch {floor} {centre} y {radius!r} steel hertz\n{STEEL}"
        )
        self.through = [("clearances/force", "touch", 0)]

    def draw_pin(self):
        """A pin loose in a bearing, pulled by springs."""
        self.bodies = [np.zeros(3)]
        centre, housing = self.point(0, np.zeros(3)), self.point(-1, np.zeros(3))
        for _ in range(3):
            self.spring(0, -1, self.bodies)
        self.others = (
            "[clearance.revolute]\nname bearing journal bearing_radius[m] clearance[m] material law level\n"
            f"touch {housing} {centre} {0.1 * self.size!r} {1e-3 * self.size!r} steel hertz clearance\n{STEEL}"
        )
        self.through = [("clearances/force", "touch", 0)]

    def draw_socket(self):
        """A ball loose in a socket, pulled by springs."""
        self.bodies = [np.zeros(3)]
        centre, housing = self.point(0, np.zeros(3)), self.point(-1, np.zeros(3))
        for _ in range(6):
            self.spring(0, -1, self.bodies)
        self.others = (
            "[clearance.spherical]\nname bearing journal bearing_radius[m] clearance[m] material law\n"
            f"touch {housing} {centre} {0.1 * self.size!r} {1e-3 * self.size!r} steel hertz\n{STEEL}"
        )
        self.through = [("clearances/force", "touch", 0)]

    def draw_film(self):
        """A journal in a film, driven at a speed and loaded by a force."""
        self.size = 0.1
        self.bodies = [np.zeros(3), np.zeros(3)]
        centre, axis, housing = (self.point(b, np.zeros(3)) for b in (0, 1, -1))
        turn, load = self.rng.uniform(0.0, 2.0 * math.pi), 10.0 ** self.rng.uniform(1, 3.5)
        self.loads.append((centre, load * np.array([math.cos(turn), math.sin(turn), 0.0])))
        film = ("short_exact", "finite", "long_exact", "butenschoen")[int(self.rng.integers(4))]
        self.joints.append(
            f"[joint.revolute]\nname i j\nmain {housing} {axis}\n[joint.parallel]\nname i j\ncoupling b1 b0\n"
            f"[driver.speed]\nname joint speed\nmotor main {10.0 ** self.rng.uniform(1.5, 2.7)!r}rad/s\n"
        )
        self.others = (
            "[clearance.revolute]\nname bearing journal bearing_radius[mm] clearance[mm] length[mm] level film lubricant\n"
            f"touch {housing} {centre} 50.1 0.1 60 lubricated film oil\n[lubricant]\nname viscosity\noil 0.05Pa.s\n"
            f"[film.{film}]\nname\nfilm\n"
        )
        self.through = [("clearances/film_force", "touch", 0)]

    def text(self, analysis="[analysis.static]"):
        """The deck."""
        axes = ("x", "y", "z") if self.space else ("x", "y")
        inertia = "ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2]" if self.space else "inertia[kg.m^2]"
        local = ("xi", "eta", "zeta")[: len(axes)]
        row = lambda x: " ".join(repr(float(v)) for v in x[: len(axes)])
        lines = ["deck = 1", "[scene]", f"space = {'spatial' if self.space else 'planar'}", "[bodies]"]
        lines.append(f"name mass[kg] {inertia} " + " ".join(f"{a}[m]" for a in axes))
        lines += [f"b{k} 1 " + " ".join(["0.01"] * (3 if self.space else 1)) + " " + row(r) for k, r in enumerate(self.bodies)]
        lines += ["[points]", "name body " + " ".join(f"{a}[m]" for a in local)]
        lines += [f"{n} {'ground' if b < 0 else f'b{b}'} {row(s)}" for n, (b, s) in self.points.items()]
        if self.springs:
            lines += ["[force.spring]", "name i j stiffness[N/m] free_length[m]"]
            lines += [f"s{k} {i} {j} {row([c, l])}" for k, (i, j, c, l) in enumerate(self.springs)]
        if self.loads:
            lines += ["[force.point]", "name point " + " ".join(f"f{a}[N]" for a in axes)]
            lines += [f"load{k} {p} {row(f)}" for k, (p, f) in enumerate(self.loads)]
        return "\n".join([*lines, *self.joints, self.others, analysis, "[output]\nchannels = *\n"])

    def residuals(self, run):
        """Of each body: the residual of forces and moments, the sum of their magnitudes, and roundings of stiffness times length."""
        frames = [self.frame(run, f"b{k}") for k in range(len(self.bodies))]
        place = lambda n: (lambda b, s: s if b < 0 else frames[b][0] + frames[b][1] @ s)(*self.points[n])
        acting = [(b, place(p), f) for p, f in self.loads for b in [self.points[p][0]]]
        stiffness = sum(k for _, _, k, _ in self.springs)
        for i, j, k, free in self.springs:
            d = place(j) - place(i)
            pull = k * (np.linalg.norm(d) - free) * d / np.linalg.norm(d)
            acting += [(self.points[i][0], place(i), pull), (self.points[j][0], place(j), -pull)]
        for channel, item, body in self.through:
            force = np.zeros(3)
            values = run.item(channel, item).ravel()
            force[: values.size] = values
            acting.append((body, frames[body][0], force))
            if self.kind != "film":  # a contact by Hertz
                depth = run.read("clearances/contacts/penetration").ravel()[0]
                stiffness += 1.5 * np.linalg.norm(force) / max(depth, 1e-300)
        found = []
        for body, (centre, _) in enumerate(frames):
            mine = [(p - centre, f) for b, p, f in acting if b == body]
            if self.kind == "rail":
                mine = [(s, f * np.array([0.0, 1.0, 0.0])) for s, f in mine]
                moments = np.zeros(3)
            else:
                moments = sum((np.cross(s, f) for s, f in mine), np.zeros(3)) / self.size
            rest = np.linalg.norm(sum((f for _, f in mine), np.zeros(3))) + np.linalg.norm(moments)
            size = sum(np.linalg.norm(f) * (1.0 + np.linalg.norm(s) / self.size) for s, f in mine)
            found.append((rest, size, EPS * stiffness * (self.size + np.linalg.norm(centre))))
        return found

    def frame(self, run, body):
        """Centre and axes of a body."""
        r = np.zeros(3)
        position = run.item("bodies/position", body).ravel()
        r[: position.size] = position
        if self.space:
            e = run.item("bodies/orientation", body).ravel()
            v = e[1:]
            cross = np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])
            return r, (e[0] ** 2 - v @ v) * np.eye(3) + 2.0 * np.outer(v, v) + 2.0 * e[0] * cross
        c, s = (f(run.item("bodies/angle", body).ravel()[0]) for f in (np.cos, np.sin))
        return r, np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])


def mistakes_of(program, kind, seed, directory):
    """What is wrong with the equilibrium of a scene, in words."""
    scene = Scene(kind, seed)
    deck = written(directory, scene.text())
    done = call(program, "run", deck, "--out", directory / "out", "--quiet", "--write", "channels", expect=None)
    if done.returncode != 0:
        return [done.stderr.strip().splitlines()[0]]
    return [
        f"b{k}: residual {rest:.1e} N, {rest / max(acting, 1e-300):.1e} relative to the acting forces, {rest / rounding:.1f} roundings"
        for k, (rest, acting, rounding) in enumerate(scene.residuals(Run(directory / "out", done)))
        if not (rest <= ENOUGH * acting or rest <= ROUNDINGS * rounding)
    ]


def wrong_scenes(program, each=EACH):
    """Lines about scenes without weight whose equilibrium is wrong; says how many there were."""
    wrong = [f"{k} {n}: {'; '.join(m)}" for k in KINDS for n in range(each) if (m := mistakes_of(program, k, n, scratch()))]
    print(f"{each * len(KINDS)} random scenes at rest without weight, {len(wrong)} mistakes")
    return wrong
