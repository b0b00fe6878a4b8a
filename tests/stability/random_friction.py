"""Random scenes of bodies that rub by Coulomb's law, one to three contacts at once: pins, balls in sockets, pins in bushings, blocks in
guides, discs on planes and on discs.

Each scene has two friction laws of the same coefficients: `coulomb`, which sticks, and `smooth`, that of Brown and McPhee with a
transition speed of TRANSITION, which creeps. The parameter `friction` names the one that rubs.
"""

import dataclasses
import math

import numpy as np

KINDS = ("pin", "socket", "bushing", "block", "disc")
METHODS = ("verner", "dop853", "rk4", "radau", "rock4", "adams", "bdf")  # ida solves for no accelerations, and refuses the law
END = 0.05  # of a scene [s]
TRANSITION = 1e-3  # of the smooth law, and of the others [m/s]
OTHER_LAWS = ("constant_dry", "constant", "ambrosio", "rooney_deravi", "threlfall", "threlfall_exponential", "threlfall_book",
              "stribeck", "lugre", "dahl")
YOUNG, POISSON, DENSITY = 207e9, 0.3, 7800.0
MODULUS = YOUNG/(2.0*(1.0 - POISSON**2))  # of two equal materials, over two [Pa]
G = 9.81  # [m/s^2]
HERTZIAN = ("hertz", "lankarani_nikravesh", "hunt_crossley", "gonthier", "flores", "hu_guo", "exact", "lee_wang", "zhiying_qishao")
OF_CYLINDERS = ("johnson", "radzimovsky", "dubowsky_freudenstein", "esdu", "liu", "pereira", "persson")


@dataclasses.dataclass(frozen=True)
class Scene:
    """A deck, and what a method of fixed steps must know of it."""

    label: str
    text: str
    step: float  # a hundredth of a slow elastic impact [s]
    tables: dict  # of `OTHER_LAWS`

    @property
    def kind(self):
        """What it is of."""
        return self.label.split()[0]


def number(rng, low, high):
    """A random number."""
    return float(rng.uniform(low, high))


def scale(rng, low, high):
    """A random number whose logarithm is uniform."""
    return math.exp(number(rng, math.log(low), math.log(high)))


def rotation(rng):
    """A random rotation: matrix, and axis and angle in words."""
    axis = rng.normal(size=3)
    axis /= np.linalg.norm(axis)
    angle = number(rng, -3.0, 3.0)
    k = np.array([[0.0, -axis[2], axis[1]], [axis[2], 0.0, -axis[0]], [-axis[1], axis[0], 0.0]])
    return np.eye(3) + math.sin(angle)*k + (1.0 - math.cos(angle))*(k @ k), f"{words(axis)} {angle!r}"


def words(vector):
    """A vector in a deck."""
    return '"' + " ".join(repr(float(x)) for x in vector) + '"'


def laws(rng, kind, weight):
    """The tables of the normal law and of both friction laws, and of other friction laws with the same coefficients by name."""
    name = str(rng.choice(HERTZIAN + (OF_CYLINDERS if kind == "pin" else ())))
    restitution = number(rng, 0.5, 0.9)
    coefficient = scale(rng, 0.03, 1.0)
    static = coefficient*(1.0 if rng.random() < 0.5 else number(rng, 1.0, 1.5))
    columns, values = ("name", "law") if name == "hertz" else ("name restitution", f"law {restitution!r}")
    return (f"[contact.{name}]\n{columns}\n{values}\n"
            f"[friction.coulomb]\nname coefficient static_coefficient\ncoulomb {coefficient!r} {static!r}\n"
            f"[friction.brown_mcphee]\nname coefficient static_coefficient v_t[m/s]\nsmooth {coefficient!r} {static!r} {TRANSITION!r}\n",
            other_laws(coefficient, static, coefficient*weight))


def other_laws(coefficient, static, force):
    """Tables of `OTHER_LAWS`."""
    both = f"{coefficient!r} {static!r}"
    rows = {
        "constant_dry": ("constant", "force[N] v1[m/s]", f"{force!r} 0"),
        "constant": ("constant", "force[N] v1[m/s]", f"{force!r} {TRANSITION}"),
        "ambrosio": ("ambrosio", "coefficient v0[m/s] v1[m/s]", f"{coefficient!r} {0.1*TRANSITION!r} {TRANSITION}"),
        "rooney_deravi": ("rooney_deravi", "coefficient v1[m/s]", f"{coefficient!r} {TRANSITION}"),
        "threlfall": ("threlfall", "coefficient v_r[m/s] above", f"{coefficient!r} {TRANSITION} continuous"),
        "threlfall_exponential": ("threlfall", "coefficient v_r[m/s] above", f"{coefficient!r} {TRANSITION} exponential"),
        "threlfall_book": ("threlfall", "coefficient v_r[m/s] above", f"{coefficient!r} {TRANSITION} book"),
        "stribeck": ("stribeck", "coefficient static_coefficient stribeck_speed[m/s] v0[m/s]", f"{both} {10*TRANSITION} {TRANSITION}"),
        "lugre": ("lugre", "coefficient static_coefficient stribeck_speed[m/s]", f"{both} {TRANSITION}"),
        "dahl": ("dahl", "coefficient", f"{coefficient!r}"),
    }
    return {name: f"[friction.{law}]\nname {columns}\n{name} {values}\n" for name, (law, columns, values) in rows.items()}


def finish(label, rng, lines, is_spatial, mass, radius, tilt):
    """The scene from its tables."""
    if is_spatial:
        gravity = words(G*np.array([math.sin(tilt), 0.0, -math.cos(tilt)])).strip('"')
        space = "space = spatial\n"
    else:
        gravity, space = f"{G*math.sin(tilt)!r} {-G*math.cos(tilt)!r}", ""
    tables, others = laws(rng, label.split()[0], mass*G)
    text = (f"deck = 1\n[scene]\n{space}gravity = {gravity} m/s^2\n[parameters]\nfriction = coulomb\n[analysis.dynamic]\n"
            f"start = given\noverlap = preload\nend = {END!r} s\ntolerance = 1e-8\n[output]\nevery = {END/50!r} s\n"
            f"channels = energy.* *.position *.friction_force *.penetration *.angular_velocity\n"
            f"[material]\nname young[GPa] poisson\nsteel {YOUNG/1e9} {POISSON}\n") + tables + lines
    stiffness = 4.0/3.0*MODULUS*math.sqrt(radius)
    return Scene(label, text, 0.01*2.9432*(1.25*mass/stiffness)**0.4*0.03**-0.2, others)


def draw(kind, seed):
    """Scene number `seed` of a kind."""
    rng = np.random.default_rng([seed, KINDS.index(kind), 17])
    return {"pin": pin, "socket": socket, "bushing": bushing, "block": block, "disc": disc}[kind](rng, f"{kind} {seed}")


def planar_body(mass, inertia, place, angle, velocity, spin, name="b", head=True):
    """A row of the table of bodies."""
    row = " ".join(repr(float(x)) for x in (mass, inertia, *place, angle, *velocity, spin))
    return ("[bodies]\nname mass[kg] inertia[kg.m^2] x[m] y[m] angle[rad] vx[m/s] vy[m/s] omega[rad/s]\n" if head else "") + f"{name} {row}\n"


def motion_of(rng, dimension):
    """Velocity and spin at the start: of every other scene none, so that surfaces meet without sliding."""
    if rng.random() < 0.5:
        return np.zeros(dimension), np.zeros(1 if dimension == 2 else 3)
    return rng.uniform(-0.1, 0.1, dimension), rng.uniform(-3.0, 3.0, 1 if dimension == 2 else 3)


def pin(rng, label):
    """A body on one to three loose pins, in the middle of each."""
    count, mass = int(rng.integers(1, 4)), scale(rng, 0.1, 5.0)
    arm, radius, gap = number(rng, 0.05, 0.4), scale(rng, 0.005, 0.03), scale(rng, 1e-5, 4e-4)
    angle = number(rng, -3.0, 3.0)
    velocity, spin = motion_of(rng, 2)
    if count > 1:
        spin = 0.1*spin
    c, s = math.cos(angle), math.sin(angle)
    lines = planar_body(mass, mass*arm**2*number(rng, 0.05, 0.5), (0.0, 0.0), angle, velocity, spin[0])
    points, pins = "[points]\nname body xi[m] eta[m]\n", ""
    for k in range(count):
        xi, eta = (-arm, 0.0) if k == 0 else (number(rng, -arm, arm), number(rng, -arm, arm))
        points += f"g{k} ground {c*xi - s*eta!r} {s*xi + c*eta!r}\np{k} b {xi!r} {eta!r}\n"
        pins += f"j{k} g{k} p{k} {radius!r} {gap!r} 0.02 steel law {{friction}}\n"
    lines += points + "[clearance.revolute]\nname bearing journal bearing_radius[m] clearance[m] length[m] material law friction\n" + pins
    return finish(label, rng, lines, False, mass, radius**2/gap, 0.0)


def spatial_body(rng, mass, size):
    """A body in space and its rotation."""
    turn, text = rotation(rng)
    velocity, spin = motion_of(rng, 3)
    inertia = mass*size**2*rng.uniform(0.35, 0.45, 3)
    row = " ".join(repr(float(x)) for x in (mass, *inertia, 0.0, 0.0, 0.0))
    tail = " ".join(repr(float(x)) for x in (*velocity, *spin))
    return turn, ("[bodies]\nname mass[kg] ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2] x[m] y[m] z[m] axis angle[rad] vx[m/s] vy[m/s] vz[m/s] "
                  f"wx[rad/s] wy[rad/s] wz[rad/s]\nb {row} {text} {tail}\n")


def socket(rng, label):
    """A body on one to three balls loose in sockets."""
    count, mass, arm = int(rng.integers(1, 4)), scale(rng, 0.1, 5.0), number(rng, 0.05, 0.3)
    radius, gap = scale(rng, 0.005, 0.03), scale(rng, 1e-5, 4e-4)
    turn, lines = spatial_body(rng, mass, arm)
    points, balls = "[points]\nname body xi[m] eta[m] zeta[m]\n", ""
    for k in range(count):
        on_body = rng.uniform(-arm, arm, 3)
        at = turn @ on_body
        points += f"g{k} ground " + " ".join(repr(float(x)) for x in at) + "\n"
        points += f"p{k} b " + " ".join(repr(float(x)) for x in on_body) + "\n"
        balls += f"j{k} g{k} p{k} {radius!r} {gap!r} steel law {{friction}}\n"
    lines += points + "[clearance.spherical]\nname bearing journal bearing_radius[m] clearance[m] material law friction\n" + balls
    return finish(label, rng, lines, True, mass, radius**2/gap, 0.0)


def bushing(rng, label):
    """A body on a pin loose in a bushing: contact at both of its ends."""
    mass, arm = scale(rng, 0.1, 5.0), number(rng, 0.02, 0.3)
    radius, gap = scale(rng, 0.005, 0.03), scale(rng, 1e-5, 4e-4)
    turn, lines = spatial_body(rng, mass, max(arm, 0.05))
    on_body = rng.uniform(-arm, arm, 3)
    axis = rng.normal(size=3)
    at = turn @ on_body
    lines += "[points]\nname body xi[m] eta[m] zeta[m]\n"
    lines += "g ground " + " ".join(repr(float(x)) for x in at) + "\np b " + " ".join(repr(float(x)) for x in on_body) + "\n"
    lines += ("[clearance.revolute]\nname bearing journal axis_i bearing_radius[m] clearance[m] length[m] material law friction\n"
              f"j g p {words(axis/np.linalg.norm(axis))} {radius!r} {gap!r} {number(rng, 0.02, 0.06)!r} steel law {{friction}}\n")
    return finish(label, rng, lines, True, mass, radius**2/gap, 0.0)


def block(rng, label):
    """A block loose in a guide that is tilted, in the plane or in space."""
    mass, length, height = scale(rng, 0.1, 5.0), number(rng, 0.03, 0.2), number(rng, 0.02, 0.1)
    gap, radius, tilt = scale(rng, 1e-5, 4e-4), scale(rng, 1e-3, 1e-2), number(rng, 0.0, 1.2)
    if rng.random() < 0.6:
        velocity, spin = motion_of(rng, 2)
        lines = planar_body(mass, mass*length**2/6.0, (0.0, 0.0), 0.0, velocity, 0.1*spin[0])
        lines += ("[points]\nname body xi[m] eta[m]\no ground 0 0\nc b 0 0\n[clearance.translational]\n"
                  "name guide slider axis length[m] height[m] gap[m] corner_radius[m] material law friction\n"
                  f"j o c x {length!r} {height!r} {gap!r} {radius!r} steel law {{friction}}\n")
        return finish(label, rng, lines, False, mass, radius, tilt)
    velocity, spin = motion_of(rng, 3)
    row = " ".join(repr(float(x)) for x in (mass, *(mass*length**2/6.0*rng.uniform(0.9, 1.1, 3)), 0.0, 0.0, 0.0))
    tail = " ".join(repr(float(x)) for x in (*velocity, *(0.1*spin)))
    lines = ("[bodies]\nname mass[kg] ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2] x[m] y[m] z[m] vx[m/s] vy[m/s] vz[m/s] wx[rad/s] wy[rad/s] "
             f"wz[rad/s]\nb {row} {tail}\n[points]\nname body xi[m] eta[m] zeta[m]\no ground 0 0 0\nc b 0 0 0\n[clearance.translational]\n"
             'name guide slider axis_i width[m] height[m] length[m] gap[m] corner_radius[m] material law friction\n'
             f'j o c "1 0 0" {height!r} {height!r} {length!r} {gap!r} {radius!r} steel law {{friction}}\n')
    return finish(label, rng, lines, True, mass, radius, tilt)


def disc(rng, label):
    """A disc or ball on one plane, in the corner of two, and one more on top of it: one to three contacts."""
    count, is_spatial = int(rng.integers(1, 4)), rng.random() < 0.3
    mass, radius, gap = scale(rng, 0.1, 5.0), scale(rng, 0.01, 0.1), scale(rng, 1e-6, 1e-3)
    if rng.random() < 0.3:
        gap = -1e-3*radius*number(rng, 1e-3, 1e-2)  # it begins in contact
    half = number(rng, 0.4, 1.2)  # from the vertical to either plane of a corner
    normals = [(0.0, 1.0)] if count == 1 else [(math.cos(half), math.sin(half)), (-math.cos(half), math.sin(half))]
    d = 3 if is_spatial else 2
    place = np.zeros(d)
    feet = []
    for n in normals:
        n_world = np.array([n[0], 0.0, n[1]]) if is_spatial else np.array(n)
        feet.append((place - (radius + gap)*n_world, n_world))
    bodies, points, tables = "", "", ""
    for k in range(2 if count == 3 else 1):
        velocity, spin = motion_of(rng, d)
        at = place + (0.0 if k == 0 else (2.0*radius + abs(gap))*np.array([0.2, 0.0, math.sqrt(0.96)] if is_spatial else
                                                                         [0.2, math.sqrt(0.96)]))
        j = 0.4*mass*radius**2
        inertia = [j, j, j] if is_spatial else [j]
        angle = [] if is_spatial else [0.0]
        bodies += f"b{k} " + " ".join(repr(float(x)) for x in (mass, *inertia, *at, *angle, *velocity, *(5.0*spin))) + "\n"
        points += f"c{k} b{k} " + " ".join(["0"]*d) + "\n"
    if is_spatial:
        lines = ("[bodies]\nname mass[kg] ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2] x[m] y[m] z[m] vx[m/s] vy[m/s] vz[m/s] wx[rad/s] "
                 f"wy[rad/s] wz[rad/s]\n{bodies}[points]\nname body xi[m] eta[m] zeta[m]\n{points}")
    else:
        lines = (f"[bodies]\nname mass[kg] inertia[kg.m^2] x[m] y[m] angle[rad] vx[m/s] vy[m/s] omega[rad/s]\n{bodies}"
                 f"[points]\nname body xi[m] eta[m]\n{points}")
    for k, (foot, n) in enumerate(feet):
        lines += f"o{k} ground " + " ".join(repr(float(x)) for x in foot) + "\n"
        if is_spatial:
            tables += f"pl{k} o{k} c0 {words(n)} {radius!r} steel law {{friction}}\n"
        else:
            tables += f"pl{k} o{k} c0 x {math.atan2(n[1], n[0])!r} {radius!r} steel law {{friction}}\n"
    lines += f"[clearance.plane]\nname plane ball {'axis_i' if is_spatial else 'axis axis_angle[rad]'} radius[m] material law friction\n"
    lines += tables
    if count == 3:
        lines += ("[clearance.discs]\nname i j radius_i[m] radius_j[m] material law friction\n"
                  f"dd c0 c1 {radius!r} {radius!r} steel law {{friction}}\n")
    return finish(label, rng, lines, is_spatial, mass, radius, number(rng, -0.3, 0.3))
