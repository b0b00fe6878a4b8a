"""Scenes that gudgeon and its peers solve alike, as plain data: a tree of bodies, pins that close its loops, forces.

A body's frame sits at the joint to its parent. SI units throughout; angles and rates are relative to the parent, and there is
motion in the plane only. `at` is the place of the joint in the parent's frame; `centre` that of the centre of mass in the body's own. A
`slide` moves along the parent's x axis. Writes the scene for the peers as lines of words and numbers, and as a deck of gudgeon.
"""

import math

GROUND = -1


def body(parent, at, mass, inertia, centre, angle=0.0, rate=0.0, kind="pin"):
    """A body and the joint to its parent; of a slide, angle and rate are the way and the speed."""
    return {"parent": parent, "at": at, "mass": mass, "inertia": inertia, "centre": centre, "angle": angle, "rate": rate, "kind": kind}


def scene(name, size, end, bodies, gravity=(0.0, 0.0), **more):
    """A scene; `size` is the length that errors of positions are told by."""
    return {"name": name, "size": size, "end": end, "gravity": gravity, "bodies": bodies,
            "pins": [], "springs": [], "torques": [], "driven": [], "loose": [], **more}


def chain(n):
    """N uniform rods of 0.1 m and 0.1 kg, pinned end to end, released horizontally; 1 s."""
    length, mass = 0.1, 0.1
    rods = [body(k - 1, (0.0, 0.0) if k == 0 else (length, 0.0), mass, mass*length**2/12, (length/2, 0.0)) for k in range(n)]
    return scene(f"chain_{n}", n*length, 1.0, rods, (0.0, -9.81))


def four_bars(n):
    """IFToMM A02: N windows of rods of 1 m and 1 kg; 10 s."""
    rods = [body(GROUND, (0.0, 0.0), 1.0, 1/12, (0.5, 0.0), math.pi/2, -1.0)]
    pins = []
    for k in range(1, n + 1):
        rods.append(body(GROUND, (float(k), 0.0), 1.0, 1/12, (0.5, 0.0), math.pi/2, -1.0))
        upright = 2*k - 1
        rods.append(body(max(0, upright - 2), (1.0, 0.0), 1.0, 1/12, (0.5, 0.0), -math.pi/2, 1.0))
        pins.append((2*k, (1.0, 0.0), upright, (1.0, 0.0)))
    return scene(f"four_bars_{n}", 1.0, 10.0, rods, (0.0, -9.81), pins=pins)


def andrews():
    """IFToMM A03, Andrews' squeezer: data and start of the Test Set for Initial Value Problem Solvers; 0.03 s."""
    beta, gamma, phi, delta = -0.0617138900142764, 0.455279819163070, 0.222668390165886, 0.487364979543843
    omega, epsilon = -0.222668390165886, 1.23054744454982
    a, b, c = (-0.06934, -0.00227), (-0.03635, 0.03273), (0.014, 0.072)
    theta = 0.0
    bodies = [
        body(GROUND, (0.0, 0.0), 0.04325, 2.194e-6, (0.00092, 0.0), beta),
        body(0, (0.007, 0.0), 0.00365, 4.410e-7, (-0.0115, 0.0), theta),
        body(GROUND, b, 0.02373, 5.255e-6, (0.01043, -0.01874), gamma),
        body(GROUND, a, 0.07050, 1.169e-5, (0.00916, 0.02308), delta),
        body(3, (0.04, 0.0), 0.00706, 5.667e-7, (0.0, -(0.02 - 0.01421)), phi),
        body(GROUND, a, 0.05498, 1.912e-5, (0.01228, -0.00449), epsilon),
        body(5, (0.0, -0.04), 0.00706, 5.667e-7, (0.02 - 0.01421, 0.0), omega),
    ]
    pins = [(1, (-0.028, 0.0), 2, (0.0, -0.035)), (1, (-0.028, 0.0), 4, (0.0, -0.02)), (1, (-0.028, 0.0), 6, (0.02, 0.0))]
    return scene("andrews", 0.04, 0.03, bodies, pins=pins, torques=[(0, 0.033)],
                 springs=[(GROUND, c, 2, (0.02, -0.018), 4530.0, 0.07785)])


def slider_crank():
    """The dry slider-crank of Flores et al. (2008), section 4.4, its first 3.4 ms: ten onsets."""
    speed, crank, rod = 5000.0*2*math.pi/60, 0.05, 0.12
    bodies = [
        body(GROUND, (0.0, 0.0), 0.30, 1.0e-4, (crank/2, 0.0), 0.0, speed),
        body(0, (crank, 0.0), 0.21, 2.5e-4, (rod/2, 0.0), 0.0, -speed*(1 + crank/rod)),
        body(GROUND, (0.0, 0.0), 0.14, 1.0e-4, (0.0, 0.0), crank + rod, 0.0, "slide"),
    ]
    compliance = (1 - 0.3**2)/207e9
    c, radius, restitution = 0.5e-3, 0.01, 0.9
    stiffness = 4/(3*2*compliance)*math.sqrt(radius*(radius - c)/c)
    return scene("slider_crank", rod, 3.4e-3, bodies, driven=[(0, speed)],
                 loose=[(2, (0.0, 0.0), 1, (rod, 0.0), c, stiffness, 0.75*(1 - restitution**2))])


def spatial(name, size, deck, bodies, loose=(), **parameters):
    """A scene of space: a deck, and the program simbody_space, which has it built in and tells of these bodies in this order."""
    return {"name": name, "size": size, "deck": deck, "bodies": bodies, "parameters": parameters, "loose": loose}


SPATIAL = (
    spatial("bricard", 1.0, "inputs/hard/a04_bricard.deck", ("one", "two", "three", "four", "five")),
    spatial("governor", 1.0, "inputs/hard/a05_flyball.deck", ("shaft", "slider", "left", "right")),
    spatial("spatial_slider_crank", 0.4, "inputs/hard/spatial_slider_crank.deck", ("crank", "slider", "coupler"), speed="0 rad/s"),
    spatial("ball_pendulum", 0.1, "tests/bench/peers/ball_pendulum.deck", ("rod",), ("pin",)),
)


def lines(it):
    """The scene for a peer: a keyword and numbers on each line."""
    def row(word, *values):
        flat = [v for value in values for v in (value if isinstance(value, (tuple, list)) else (value,))]
        return " ".join([word, *(repr(v) for v in flat)])

    yield row("gravity", it["gravity"])
    yield row("end", it["end"])
    for b in it["bodies"]:
        yield row(b["kind"], b["parent"], b["at"], b["mass"], b["inertia"], b["centre"], b["angle"], b["rate"])
    for word, key in (("join", "pins"), ("spring", "springs"), ("torque", "torques"), ("drive", "driven"), ("loose", "loose")):
        for one in it[key]:
            yield row(word, *one)


def placed(it):
    """Angle, origin, rate and velocity of each body at the start, in the ground's frame."""
    found = []
    for b in it["bodies"]:
        p = found[b["parent"]] if b["parent"] >= 0 else (0.0, (0.0, 0.0))
        (x, y), (c, s) = b["at"], (math.cos(p[0]), math.sin(p[0]))
        if b["kind"] == "slide":
            x += b["angle"]
        origin = (p[1][0] + c*x - s*y, p[1][1] + s*x + c*y)
        found.append((p[0] + (b["angle"] if b["kind"] == "pin" else 0.0), origin))
    return found


def deck(it, method, stabilise, ledger="off"):
    """The scene as a deck of gudgeon, whose joints of the tree become revolute joints; `{tolerance}` is a parameter."""
    def point(name, owner, at):
        if owner == GROUND:
            return f"{name} ground {at[0]!r} {at[1]!r}"
        centre = it["bodies"][owner]["centre"]
        return f"{name} b{owner} {at[0] - centre[0]!r} {at[1] - centre[1]!r}"

    places, points, joints, speeds, guides = placed(it), ["origin ground 0.0 0.0"], [], [], []
    bodies = []
    for k, (b, (angle, origin)) in enumerate(zip(it["bodies"], places)):
        c, s = math.cos(angle), math.sin(angle)
        (cx, cy) = b["centre"]
        bodies.append(f"b{k} {b['mass']!r} {b['inertia']!r} {origin[0] + c*cx - s*cy!r} {origin[1] + s*cx + c*cy!r} {angle!r}")
        points += [point(f"p{k}", b["parent"], b["at"]), point(f"o{k}", k, (0.0, 0.0))]
        (joints if b["kind"] == "pin" else guides).append(f"j{k} p{k} o{k}")
        if b["kind"] == "pin" and b["rate"] != 0.0 and not it["loose"] and b["parent"] == GROUND and k == 0:
            speeds.append(f"start{k} j{k} {b['rate']!r}")
    for k, (i, at, j, other) in enumerate(it["pins"]):
        points += [point(f"li{k}", i, at), point(f"lj{k}", j, other)]
        joints.append(f"l{k} li{k} lj{k}")
    parts = [("bodies", "name mass inertia x y angle", bodies)]
    tables = [("joint.revolute", "name i j", joints), ("joint.translational", "name i j axis", [f"{g} x" for g in guides]),
              ("initial.speed", "name joint speed", speeds)]
    for k, (i, at, j, other, stiffness, free) in enumerate(it["springs"]):
        points += [point(f"si{k}", i, at), point(f"sj{k}", j, other)]
        tables.append(("force.spring", "name i j stiffness free_length", [f"s{k} si{k} sj{k} {stiffness!r} {free!r}"]))
    for k, (i, torque) in enumerate(it["torques"]):
        tables.append(("force.torque", "name body moment", [f"t{k} b{i} {{{torque!r} N.m}}"]))
    for k, (i, speed) in enumerate(it["driven"]):
        tables.append(("driver.speed", "name joint speed", [f"d{k} j{i} {{{speed!r} rad/s}}"]))
    for k, (i, at, j, other, c, _, _) in enumerate(it["loose"]):
        points += [point(f"bearing{k}", i, at), point(f"journal{k}", j, other)]
        tables += [("material", "name young[GPa] poisson density[kg/m^3]", ["steel 207 0.3 7850"]),
                   ("contact.lankarani_nikravesh", "name restitution", ["law 0.9"]),
                   ("clearance.revolute", "name bearing journal bearing_radius clearance material law",
                    [f"loose{k} bearing{k} journal{k} {{0.01 m}} {{{c!r} m}} steel law"])]
    parts.append(("points", "name body xi[m] eta[m]", points))
    parts += [t for t in tables if t[2]]
    gravity = " ".join(repr(g) for g in it["gravity"])
    text = f'deck = 1\n\n[scene]\ntitle = "{it["name"]}"\ngravity = {gravity} m/s^2\n'
    for name, head, rows in parts:
        if name == "bodies":
            head = "name mass[kg] inertia[kg.m^2] x[m] y[m] angle[rad]"
        elif name == "initial.speed":
            head = "name joint speed[rad/s]"
        elif name == "force.spring":
            head = "name i j stiffness[N/m] free_length[m]"
        text += f"\n[{name}]\n{head}\n" + "\n".join(rows) + "\n"
    start = "start = ideal\n" if it["loose"] else ""
    return text + (f"\n[analysis.dynamic]\n{start}end = {it['end']!r} s\nmethod = {method}\nstabilise = {stabilise}\nledger = {ledger}\n"
                   f"\n[output]\nevery = {it['end']!r} s\nchannels = {' '.join(f'b{k}.position' for k in range(len(bodies)))}\n"
                   "contact_rows = off\n")
