"""Random scenes whose contacts begin together: a block flat in a guide, a bar on two or three loose pins, a ball in a corner, each at a
random place, tilt and size.

A scene that falls along its line of symmetry is a motion in one coordinate x, n contacts that begin and end together, their normals
at an angle to the fall:

    m x'' = m g - n c F(delta, delta', v),   delta = c x - gap,   c the cosine of that angle,

F the law of Lankarani and Nikravesh, v the rate of delta at its onset. That is integrated here, with another method than those of
the program. Scenes that are not symmetric have spin or speed beside the fall; of them only is known what holds for every contact.
"""

import dataclasses
import functools
import math

import numpy as np
from scipy.integrate import solve_ivp

YOUNG, POISSON, DENSITY = 207e9, 0.3, 7800.0
MODULUS = YOUNG/(2.0*(1.0 - POISSON**2))  # of two equal materials, over two [Pa]
G = 9.81  # [m/s^2]
IMPACTS = 4  # onsets to be compared with the reference
LEAST_SPEED = 1e-2  # slowest impact that is: well above the floor of the law [m/s]
KINDS = ("block", "bar_2", "bar_3", "corner", "flat_block", "straight_bar")


class Rests(Exception):
    """A fall whose last impact does not end: the body stays where it is, pressed in by its weight."""


@dataclasses.dataclass(frozen=True)
class Scene:
    """A deck, and what is known of its motion."""

    label: str
    text: str
    mass: float  # of the body [kg]
    stiffness: float  # of one contact [N/m^1.5]
    gap: float  # of every contact, along its normal [m]
    count: int  # contacts that begin together
    cosine: float  # of the angle from the fall to their normals [1]
    restitution: float
    end: float  # [s]
    is_symmetric: bool

    @property
    def kind(self):
        """What it is of."""
        return self.label.split()[0]

    def shortest(self, speed):
        """A hundredth of the time that an elastic impact of the whole body takes at a speed [s]."""
        return 0.01*2.9432*(1.25*self.mass/self.stiffness)**0.4*speed**-0.2


def stiffness_of(radius):
    """Hertz, of a sphere of this (effective) radius [N/m^1.5]."""
    return 4.0/3.0*MODULUS*math.sqrt(radius)


def fall(scene):
    """Onsets, impact speeds and ends of the first impacts of a symmetric scene."""
    return impacts_of(scene.mass, scene.stiffness, scene.gap, scene.count, scene.cosine, scene.restitution)


@functools.lru_cache(maxsize=None)
def impacts_of(m, k, gap, n, c, restitution):
    """The same from numbers; an impact that does not end is none."""
    damping = 0.75*(1.0 - restitution**2)
    x_0 = gap/c
    t, speed = math.sqrt(2.0*x_0/G), math.sqrt(2.0*x_0*G)
    size = (1.25*m*speed**2/(n*k))**0.4  # of the penetration: what is integrated has magnitudes near one
    rows = []
    for _ in range(IMPACTS):
        duration = size/speed
        impact = c*speed

        def slopes(_, y, impact=impact, duration=duration):
            delta, rate = max(c*y[0]*size, 0.0), c*y[1]*size/duration
            force = k*delta**1.5*max(1.0 + damping*rate/impact, 0.0)
            return [y[1], (G - n*c*force/m)*duration**2/size]

        def depth(_, y):
            return y[0]

        depth.terminal, depth.direction = True, -1
        part = solve_ivp(slopes, (0.0, 100.0), [0.0, speed*duration/size], method="DOP853", rtol=1e-13, atol=1e-15, events=depth,
                         max_step=0.02)
        if not part.t_events[0].size:
            raise Rests
        lasting, release = part.t_events[0][0]*duration, -part.y_events[0][0][1]*size/duration
        rows.append((t, impact, t + lasting, c*release))
        t += lasting + 2.0*release/G
        speed = release
    return np.array(rows)


def deck(scene_lines, angle, end, law):
    """The parts that all decks have."""
    return f"""deck = 1
[scene]
gravity = {G*math.sin(angle)!r} {-G*math.cos(angle)!r} m/s^2
{scene_lines}
[material]
name young[GPa] poisson
steel {YOUNG/1e9} {POISSON}
[contact.lankarani_nikravesh]
name restitution
law {law}
[analysis.dynamic]
start = given
end = {end!r} s
[output]
every = {end/20!r} s
channels = energy.residual
"""


def bodies(mass, inertia, place, frame, velocity, spin):
    """The table of the one body."""
    return (f"[bodies]\nname mass[kg] inertia[kg.m^2] x[m] y[m] angle[rad] vx[m/s] vy[m/s] omega[rad/s]\n"
            f"p {mass!r} {inertia!r} {place[0]!r} {place[1]!r} {frame!r} {velocity[0]!r} {velocity[1]!r} {spin!r}\n")


def draw(kind, seed):
    """Scene number `seed` of a kind: every third one is not symmetric. One that comes to rest too early is drawn again."""
    attempt = [seed, KINDS.index(kind)]
    while True:
        try:
            return drawn(kind, seed, np.random.default_rng(attempt))
        except Rests:
            attempt.append(1)


def drawn(kind, seed, rng):
    """A scene of a kind from random numbers."""
    number = lambda low, high: float(rng.uniform(low, high))  # noqa: E731
    size = 10.0**number(-3.0, 0.0)
    tilt, frame = number(-math.pi, math.pi), number(-7.0, 7.0)
    place = np.array([number(-5.0, 5.0), number(-5.0, 5.0)])
    restitution = number(0.5, 0.95)
    is_symmetric = seed % 3 != 2
    mass = DENSITY*size**3*number(0.1, 1.0)
    inertia = mass*size**2*number(0.05, 0.2)
    gap = size*10.0**number(-2.5, -1.5)
    gap = max(gap, LEAST_SPEED**2/(2.0*G*restitution**(2*IMPACTS)))
    fall_time = math.sqrt(2.0*gap/G)
    velocity, spin = np.zeros(2), 0.0
    if not is_symmetric:
        velocity = 0.3*gap/fall_time*rng.uniform(-1.0, 1.0, 2)
        spin = 0.5*gap/fall_time/size*number(-1.0, 1.0)
    along = np.array([math.cos(tilt), math.sin(tilt)])
    across = np.array([-along[1], along[0]])
    if kind == "flat_block":
        size, mass, inertia, gap, restitution, is_symmetric = 0.1, 1.0, 0.01, 1e-3, 0.9, True
    elif kind == "straight_bar":
        size, mass, inertia, gap, restitution, is_symmetric = 0.2, 1.0, 0.01, 0.5e-3, 0.9, True
    if is_symmetric:
        velocity, spin = np.zeros(2), 0.0
    return {"block": block, "bar_2": bar, "bar_3": bar, "corner": corner, "flat_block": block, "straight_bar": bar}[kind](
        rng, f"{kind} {seed}", 3 if kind == "bar_3" else 2,
        dict(size=size, tilt=tilt, frame=frame, place=place, restitution=restitution, mass=mass, inertia=inertia, gap=gap,
             velocity=velocity.tolist(), spin=spin, along=along, across=across, is_symmetric=is_symmetric, fixed=kind in KINDS[4:]))


def local(vector, frame):
    """A vector of the world in the frame of the body."""
    c, s = math.cos(frame), math.sin(frame)
    return float(c*vector[0] + s*vector[1]), float(-s*vector[0] + c*vector[1])


def finish(label, lines, stiffness, gap, count, cosine, d):
    """The scene from its tables: it lasts until the fourth impact of the fall without spin is over."""
    scene = Scene(label, "", d["mass"], stiffness, gap, count, cosine, d["restitution"], 0.0, d["is_symmetric"])
    end = 1.01*float(fall(scene)[-1, 2])
    return dataclasses.replace(scene, text=deck(lines, d["tilt"], end, d["restitution"]), end=end)


def block(rng, label, count, d):
    """A block in the middle of a guide that falls flat."""
    size, frame = d["size"], d["frame"]
    radius = 1e-3 if d["fixed"] else size*float(rng.uniform(0.01, 0.1))
    start = (d["place"]).tolist()
    lines = bodies(d["mass"], d["inertia"], start, frame, d["velocity"], d["spin"])
    lines += (f"[points]\nname body xi[m] eta[m]\no ground {start[0]!r} {start[1]!r}\nc p 0 0\n"
              "[clearance.translational]\n"
              "name guide slider axis axis_angle[rad] slider_angle[rad] length[m] height[m] gap[m] corner_radius[m] material law\n"
              f"joint o c x {d['tilt']!r} {d['tilt'] - frame!r} {size!r} {0.5*size!r} {d['gap']!r} {radius!r} steel law\n")
    return finish(label, lines, stiffness_of(radius), d["gap"], count, 1.0, d)


def bar(rng, label, count, d):
    """A bar on loose pins that falls straight."""
    size, frame = d["size"], d["frame"]
    hole = 0.01 if d["fixed"] else max(size*float(rng.uniform(0.05, 0.2)), 2.0*d["gap"])
    lines = bodies(d["mass"], d["inertia"], d["place"].tolist(), frame, d["velocity"], d["spin"])
    points, pins = "[points]\nname body xi[m] eta[m]\n", "[clearance.revolute]\n"
    pins += "name bearing journal bearing_radius[m] clearance[m] material law\n"
    for k in range(count):
        off = (k/(count - 1) - 0.5)*size*d["along"]
        at = d["place"] + off
        xi, eta = local(off, frame)
        points += f"o{k} ground {float(at[0])!r} {float(at[1])!r}\nc{k} p {xi!r} {eta!r}\n"
        pins += f"pin{k} o{k} c{k} {hole!r} {d['gap']!r} steel law\n"
    stiffness = stiffness_of(hole*(hole - d["gap"])/d["gap"])
    return finish(label, lines + points + pins, stiffness, d["gap"], count, 1.0, d)


def corner(rng, label, count, d):
    """A ball that falls into the corner of two planes."""
    radius, frame, place = 0.5*d["size"], d["frame"], d["place"]
    half = float(rng.uniform(0.5, 1.3))  # from the line of the fall to either plane
    cosine = math.sin(half)
    lines = bodies(d["mass"], d["inertia"], place.tolist(), frame, d["velocity"], d["spin"])
    points, planes = "[points]\nname body xi[m] eta[m]\nc p 0 0\n", "[clearance.plane]\n"
    planes += "name plane ball axis axis_angle[rad] radius[m] material law\n"
    for k, side in enumerate((1.0, -1.0)):
        normal = cosine*d["across"] + side*math.cos(half)*d["along"]  # out of the plane
        foot = place - (radius + d["gap"])*normal
        points += f"o{k} ground {float(foot[0])!r} {float(foot[1])!r}\n"
        planes += f"plane{k} o{k} c y {d['tilt'] - side*(0.5*math.pi - half)!r} {radius!r} steel law\n"
    return finish(label, lines + points + planes, stiffness_of(radius), d["gap"], count, cosine, d)
