"""Every joint of space between bodies in general places, against equations of motion written down here from the definition.

Two bodies with full tensors of inertia, turned and moving anyhow, their points displaced and their axes tilted, or one of them and
the ground as i or as j. The reference has the constraints as functions of positions and rotations alone: their derivatives are found
by complex steps, their second ones by differences, multipliers and accelerations by a dense solution.
"""

import functools
import zlib

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation
from support import Run, call, scratch, written

GRAVITY = np.array([1.5, -3.0, -9.0])
TIMES = np.linspace(0, 0.4, 5)
PLACES = ("bodies", "from_ground", "to_ground")
PITCH = 0.3
SPRING = {"stiffness": 40.0, "damping": 3.0, "free_length": 0.6, "preload": 2.0}           # N/m, N.s/m, m, N
COIL = {"stiffness": 0.8, "damping": 0.05, "free_angle": 0.4, "preload": -0.1}             # N.m/rad, N.m.s/rad, rad, N.m


def cross_matrix(x):
    """The matrix of x times, for any number of vectors."""
    zero = np.zeros_like(x[..., 0])
    return np.stack([np.stack([zero, -x[..., 2], x[..., 1]], -1), np.stack([x[..., 2], zero, -x[..., 0]], -1),
                     np.stack([-x[..., 1], x[..., 0], zero], -1)], -2)


def dot(x, y):
    """Scalar products, without conjugates."""
    return np.sum(x*y, axis=-1)


def frame_of(axis):
    """x, y, z of a joint, z along an axis: x is the part across it of the body axis after (xi, eta, zeta, xi) the nearest one."""
    z = axis/np.linalg.norm(axis)
    x = np.eye(3)[(np.argmax(np.abs(z)) + 1) % 3]
    x = x - dot(x, z)*z
    x = x/np.linalg.norm(x)
    return np.stack([x, np.cross(z, x), z], axis=1)


class Joint:
    """A joint of one kind: where it is in both bodies, and its rows."""

    rows = {
        "spherical": "point", "revolute": "point parallel", "universal": "point cross", "cylindrical": "parallel inline",
        "translational": "parallel turn inline", "screw": "parallel inline screw", "planar": "parallel inplane",
        "rigid": "point parallel turn", "distance": "distance", "revolute_spherical": "inplane distance", "inline": "inline",
        "inplane": "inplane", "orientation": "parallel turn", "parallel_axes": "parallel", "perpendicular": "cross",
        "constant_velocity": "point twist",
        # driven: the joint first, then a row for each driver
        "pin and motor": "point parallel motor", "shaft, motor and pusher": "parallel inline motor pusher", "cylinder": "ram"}
    drivers = {"motor": "angle", "pusher": "position", "ram": "distance"}

    def __init__(self, kind, random, pose):
        self.kind = kind
        (r_i, rot_i), (r_j, rot_j) = pose
        self.axis = random.normal(size=3)
        self.s = random.uniform(-0.4, 0.4, (2, 3))
        self.frame = [frame_of(self.axis)]
        x, _, z = (rot_i @ self.frame[0]).T
        if "cross" in self.rows[kind]:  # the axis of j at right angles
            z = np.cross(z, random.normal(size=3))
        self.axis_j = rot_j.T @ z
        self.frame.append(frame_of(self.axis_j))
        if any(row in self.rows[kind] for row in ("turn", "screw", "motor", "twist")):
            self.frame[1] = rot_j.T @ rot_i @ self.frame[0]
        # the point of j where the rows let it be
        self.driven = [row for row in self.rows[kind].split() if row in self.drivers]
        span = {"point": np.zeros(3), "inline": 0.3*z, "inplane": 0.3*x}
        d = next((span[row] for row in ("point", "inline", "inplane") if row in self.rows[kind].split()), None)
        if d is not None:
            self.s[1] = rot_j.T @ (r_i + rot_i @ self.s[0] + d - r_j)
        self.length, self.along = 0.0, 0.0
        values = self.spans(r_i, rot_i, r_j, rot_j)
        self.length, self.along = np.sqrt(dot(values[0], values[0])), dot(values[0], rot_i @ self.frame[0][:, 2])

    def spans(self, r_i, rot_i, r_j, rot_j):
        """From point to point, and the axes of both frames."""
        d = r_j + rot_j @ self.s[1] - r_i - rot_i @ self.s[0]
        return d, np.swapaxes(rot_i @ self.frame[0], -1, -2), np.swapaxes(rot_j @ self.frame[1], -1, -2)

    def angle(self, a, b):
        """Of x_j against x_i about z_i, less than half a turn either way."""
        s, c = dot(b[..., 0, :], a[..., 1, :]), dot(b[..., 0, :], a[..., 0, :])
        return np.arctan(s/c) + np.where(np.real(c) < 0, np.pi*np.sign(np.real(s)), 0.0)

    def phi(self, r_i, rot_i, r_j, rot_j):
        """Violations, (..., rows)."""
        d, a, b = self.spans(r_i, rot_i, r_j, rot_j)
        found = []
        for row in self.rows[self.kind].split():
            if row == "point":
                found += [d[..., c] for c in range(3)]
            if row == "parallel":
                found += [dot(a[..., c, :], b[..., 2, :]) for c in (0, 1)]
            if row == "turn":
                found.append(dot(a[..., 0, :], b[..., 1, :]))
            if row == "twist":
                found.append(dot(a[..., 0, :], b[..., 1, :]) - dot(a[..., 1, :], b[..., 0, :]))
            if row == "cross":
                found.append(dot(a[..., 2, :], b[..., 2, :]))
            if row == "inline":
                found += [dot(a[..., c, :], d) for c in (0, 1)]
            if row == "inplane":
                found.append(dot(a[..., 2, :], d))
            if row == "distance":
                found.append(np.sqrt(dot(d, d)) - self.length)
            if row == "screw":
                found.append(dot(a[..., 2, :], d) - self.along - PITCH*self.angle(a, b)/(2*np.pi))
            if row == "motor":
                found.append(self.angle(a, b))
            if row == "pusher":
                found.append(dot(a[..., 2, :], d) - self.along)
            if row == "ram":
                found.append(np.sqrt(dot(d, d)) - self.length)
        return np.stack(found, -1)

    def prescribed(self, n, t, derivative):
        """A derivative of what the n rows follow: in those of drivers 0.4 t + 0.2 sin(3 t) from the start."""
        follows = np.zeros(n)
        follows[n - len(self.driven):] = {1: 0.4 + 0.6*np.cos(3*t), 2: -1.8*np.sin(3*t)}[derivative]
        return follows

    def tables(self):
        """The joint and its drivers in the deck."""
        columns = self.columns()
        words = {"axis_i": columns["axis_i"]} if "axis_i" in columns else {}
        lines = []
        joint = {"pin and motor": "revolute", "shaft, motor and pusher": "cylindrical", "cylinder": None}.get(self.kind, self.kind)
        if joint:
            lines = [f"[joint.{joint}]", " ".join(["name i j", *columns]), " ".join(["tie p_i p_j", *columns.values()])]
        for row in self.driven:
            start = {"motor": 0.0, "pusher": self.along, "ram": self.length}[row]
            unit = "rad" if row == "motor" else "m"
            follow = f"{{{float(start)!r}{unit}+0.4{unit}/(1s)*t+0.2{unit}*sin(3rad/(1s)*t)}}"
            at = ["joint", "tie"] if row == "motor" else ["i j", "p_i p_j"]
            extra = words if row == "pusher" else {}
            lines += [f"[driver.{self.drivers[row]}]", " ".join(["name", at[0], *extra, self.drivers[row]]),
                      " ".join([row, at[1], *extra.values(), follow])]
        return lines

    def columns(self):
        """Of the deck, beside the points."""
        if self.kind in ("spherical", "distance", "orientation", "cylinder"):
            return {}
        words = {"axis_i": '"' + " ".join(map(repr, self.axis.tolist())) + '"'}
        if "cross" in self.rows[self.kind]:
            words["axis_j"] = '"' + " ".join(map(repr, self.axis_j.tolist())) + '"'
        if self.kind == "screw":
            words |= {"pitch": f"{PITCH}m", "zero": "start"}
        if "motor" in self.driven:
            words["zero"] = "start"
        return words


def jacobian(joint, pose):
    """Phi_q: columns of the velocities and angular velocities (world) of i and of j."""
    h = 1e-30
    r = np.repeat(np.stack([pose[0][0], pose[1][0]])[None].astype(complex), 12, axis=0)
    rot = np.repeat(np.stack([pose[0][1], pose[1][1]])[None].astype(complex), 12, axis=0)
    for c in range(12):
        e = np.eye(3)[c % 3]*1j*h
        if c % 6 < 3:
            r[c, c//6] += e
        else:
            rot[c, c//6] = (np.eye(3) + cross_matrix(e)) @ rot[c, c//6]
    return np.imag(joint.phi(r[:, 0], rot[:, 0], r[:, 1], rot[:, 1])).T/h


def moved(pose, u, h):
    """Both bodies a time h later at steady velocities."""
    return [(r + h*u[6*k:6*k + 3], Rotation.from_rotvec(h*u[6*k + 3:6*k + 6]).as_matrix() @ rot) for k, (r, rot) in enumerate(pose)]


class Scene:
    """The two bodies, one of which may be the ground, and the joint between them."""

    def __init__(self, kind, place, has_springs=False):
        random = np.random.default_rng(zlib.crc32(f"{kind} {place}".encode()))
        self.kind = kind
        self.is_ground = {"bodies": (False, False), "from_ground": (True, False), "to_ground": (False, True)}[place]
        self.mass = random.uniform(1, 3, 2)
        turn = Rotation.random(2, random_state=int(random.integers(1 << 30))).as_matrix()
        moments = random.uniform(0.05, 0.09, (2, 3))
        self.tensor = [q @ np.diag(m) @ q.T for q, m in zip(turn, moments)]
        self.pose = []
        for is_ground in self.is_ground:
            q = Rotation.random(random_state=int(random.integers(1 << 30))).as_matrix()
            self.pose.append((np.zeros(3), np.eye(3)) if is_ground else (random.uniform(-1, 1, 3), q))
        self.joint = Joint(kind, random, self.pose)
        self.has_springs = has_springs
        if has_springs:  # the coil's angle is zero where the bodies are
            self.joint.frame[1] = self.pose[1][1].T @ self.pose[0][1] @ self.joint.frame[0]
        self.ends = random.uniform(-0.4, 0.4, (2, 3))
        self.free = np.repeat([not g for g in self.is_ground], 6)
        u = np.where(self.free, random.normal(size=12), 0.0)
        rows = jacobian(self.joint, self.pose)[:, self.free]
        u[self.free] -= np.linalg.pinv(rows) @ (rows @ u[self.free] - self.joint.prescribed(len(rows), 0.0, 1))
        self.u = u

    def springs(self, pose, u):
        """A spring between two points, a coil about the axis of the joint: force on the body of i and where it acts on both, moment on it."""
        at = [r + rot @ s for (r, rot), s in zip(pose, self.ends)]
        v = [u[6*k:6*k + 3] + np.cross(u[6*k + 3:6*k + 6], at[k] - pose[k][0]) for k in range(2)]
        d = at[1] - at[0]
        length = np.linalg.norm(d)
        tension = SPRING["stiffness"]*(length - SPRING["free_length"]) + SPRING["damping"]*dot(v[1] - v[0], d)/length + SPRING["preload"]
        _, a, b = self.joint.spans(*(x for both in pose for x in both))
        turn = COIL["stiffness"]*(self.joint.angle(a, b) - COIL["free_angle"]) + COIL["damping"]*dot(u[9:] - u[3:6], a[2]) + COIL["preload"]
        return tension*d/length, at, turn*a[2]

    def rates(self, t, pose, u):
        """Accelerations, what the joint and its drivers do to both bodies, and what a driver does along its coordinate."""
        rows = jacobian(self.joint, pose)
        h = 1e-4
        gain = [jacobian(self.joint, moved(pose, u, k*h)) @ u for k in (-2, -1, 1, 2)]
        gamma = self.joint.prescribed(len(rows), t, 2) - (gain[0] - 8*gain[1] + 8*gain[2] - gain[3])/(12*h)
        mass, load = np.zeros((12, 12)), np.zeros(12)
        for k in range(2):
            tensor = pose[k][1] @ self.tensor[k] @ pose[k][1].T
            mass[6*k:6*k + 3, 6*k:6*k + 3] = self.mass[k]*np.eye(3)
            mass[6*k + 3:6*k + 6, 6*k + 3:6*k + 6] = tensor
            w = u[6*k + 3:6*k + 6]
            load[6*k:6*k + 3] = self.mass[k]*GRAVITY
            load[6*k + 3:6*k + 6] = -np.cross(w, tensor @ w)
        if self.has_springs:
            force, at, moment = self.springs(pose, u)
            for k, sign in enumerate((1, -1)):
                load[6*k:6*k + 3] += sign*force
                load[6*k + 3:6*k + 6] += sign*(moment + np.cross(at[k] - pose[k][0], force))
        free = self.free
        n, m = int(free.sum()), len(rows)
        full = np.zeros((n + m, n + m))
        full[:n, :n] = mass[np.ix_(free, free)]
        full[:n, n:] = rows[:, free].T
        full[n:, :n] = rows[:, free]
        x = np.linalg.solve(full, np.concatenate([load[free], gamma]))
        a = np.zeros(12)
        a[free] = x[:n]
        first = m - len(self.joint.driven)
        return a, -rows[:first].T @ x[n:n + first], -x[n + first:]

    def pose_of(self, y):
        """Positions and rotations of a state (r, quaternion, u)."""
        return [self.pose[k] if self.is_ground[k] else (y[7*k:7*k + 3], Rotation.from_quat(y[7*k + 3:7*k + 7]).as_matrix()) for k in range(2)]

    def slope(self, t, y):
        """Derivative of a state."""
        u = y[14:]
        a = self.rates(t, self.pose_of(y), u)[0]
        out = []
        for k in range(2):
            q, w = y[7*k + 3:7*k + 7], u[6*k + 3:6*k + 6]
            out += [u[6*k:6*k + 3], 0.5*(q[3]*w + np.cross(w, q[:3])), [-0.5*dot(w, q[:3])]]
        return np.concatenate([*out, a])

    def solve(self):
        """States at the instants."""
        start = np.concatenate([*(np.concatenate([r, Rotation.from_matrix(q).as_quat()]) for r, q in self.pose), self.u])
        return solve_ivp(self.slope, (0, TIMES[-1]), start, method="DOP853", rtol=1e-11, atol=1e-12, t_eval=TIMES).y.T

    def deck(self):
        """The same for the program: orientations by Euler parameters and by angles, reactions on both bodies."""
        names = ["ground" if g else name for g, name in zip(self.is_ground, ("one", "two"))]
        head = "name mass[kg] ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2] ixy[kg.m^2] ixz[kg.m^2] iyz[kg.m^2] x[m] y[m] z[m] e0 e1 e2 e3 " \
               "vx[m/s] vy[m/s] vz[m/s] wx[rad/s] wy[rad/s] wz[rad/s]"
        bodies = []
        for k in range(2):
            if self.is_ground[k]:
                continue
            t, (r, rot) = self.tensor[k], self.pose[k]
            q = Rotation.from_matrix(rot).as_quat()
            numbers = [self.mass[k], t[0, 0], t[1, 1], t[2, 2], -t[0, 1], -t[0, 2], -t[1, 2], *r, q[3], *q[:3], *self.u[6*k:6*k + 6]]
            bodies.append(" ".join([names[k], *(repr(float(x)) for x in numbers)]))
        points = [" ".join([f"p_{c}", names[k], *(repr(float(x)) for x in self.joint.s[k])]) for k, c in enumerate("ij")]
        frame = next(name for name in reversed(names) if name != "ground")
        requests, springs = [], []
        if self.has_springs:
            points += [" ".join([f"e_{c}", names[k], *(repr(float(x)) for x in self.ends[k])]) for k, c in enumerate("ij")]
            requests = [f"wire_j wire j p_j {frame}", f"coil_i coil i - {frame}", f"coil_j coil j p_i {frame}"]
            axis = self.joint.columns()["axis_i"]
            springs = ["[force.spring]", "name i j stiffness[N/m] damping[N.s/m] free_length[m] preload[N]",
                       "wire e_i e_j " + " ".join(map(str, SPRING.values())),
                       "[force.torsion_spring]", "name i j axis_i zero stiffness[N.m/rad] damping[N.m.s/rad] free_angle[rad] preload[N.m]",
                       f"coil {names[0]} {names[1]} {axis} start " + " ".join(map(str, COIL.values()))]
        return "\n".join([
            "deck = 1", "[scene]", 'title = "joint"', "space = spatial", "gravity = " + " ".join(map(repr, GRAVITY.tolist())) + " m/s^2",
            "[bodies]", head, *bodies, "[points]", "name body xi[m] eta[m] zeta[m]", *points,
            *self.joint.tables(), "[request.reaction]", "name joint on point frame",
            f"on_j {'ram' if self.kind == 'cylinder' else 'tie'} j p_j {frame}", *requests, *springs,
            "[analysis.dynamic]", f"end = {TIMES[-1]} s", "tolerance = 1e-12",
            "[output]", f"every = {TIMES[1]} s", ""])


@functools.lru_cache(maxsize=None)
def made(program, kind, place, has_springs=False):
    """Scene, states elsewhere, and the run of the program at the same instants."""
    scene = Scene(kind, place, has_springs)
    directory = scratch()
    call(program, "run", written(directory, scene.deck()), "--out", directory / "out", "--quiet")
    run = Run(directory / "out")
    rows = [int(np.argmin(abs(run.time - t))) for t in TIMES]
    return scene, scene.solve(), run, rows


@pytest.mark.parametrize("place", PLACES)
@pytest.mark.parametrize("kind", Joint.rows)
def test_motion_and_reactions(gudgeon, kind, place):
    """States, accelerations, and the reaction on i and on j."""
    scene, states, run, rows = made(gudgeon, kind, place)
    moving = [k for k in range(2) if not scene.is_ground[k]]
    for t, y, row in zip(TIMES, states, rows):
        pose, u = scene.pose_of(y), y[14:]
        a, load, drives = scene.rates(t, pose, u)
        for n, k in enumerate(moving):
            own = {quantity: run.read(f"bodies/{quantity}")[row, n] for quantity in (
                "position", "velocity", "acceleration", "angular_velocity", "angular_acceleration", "spin", "orientation")}
            assert own["position"] == pytest.approx(pose[k][0], abs=1e-9)
            assert own["velocity"] == pytest.approx(u[6*k:6*k + 3], abs=1e-8)
            assert own["angular_velocity"] == pytest.approx(u[6*k + 3:6*k + 6], abs=1e-8)
            assert own["spin"] == pytest.approx(u[6*k + 3:6*k + 6] @ pose[k][1], abs=1e-8)
            assert own["acceleration"] == pytest.approx(a[6*k:6*k + 3], rel=1e-8, abs=1e-6)
            assert own["angular_acceleration"] == pytest.approx(a[6*k + 3:6*k + 6], rel=1e-8, abs=1e-6)
            e = own["orientation"]
            start = Rotation.from_matrix(scene.pose[k][1]).as_quat()
            assert np.roll(run.read("bodies/orientation")[0, n], -1) == pytest.approx(start, abs=1e-9)
            assert Rotation.from_quat([*e[1:], e[0]]).as_matrix() == pytest.approx(pose[k][1], abs=1e-9)
        at = [r + rot @ s for (r, rot), s in zip(pose, scene.joint.s)]
        for driver, drive in zip(scene.joint.driven, drives):
            assert run.item("drivers/" + ("moment" if driver == "motor" else "force"), driver)[row] == pytest.approx(drive, rel=1e-8, abs=1e-6)
        if kind == "cylinder":
            continue
        force, moment = load[:3], load[3:6] - np.cross(at[0] - pose[0][0], load[:3])
        assert run.item("joints/force", "tie")[row] == pytest.approx(force, rel=1e-8, abs=1e-6)
        assert run.item("joints/moment", "tie")[row] == pytest.approx(moment, rel=1e-8, abs=1e-6)
        if kind != "distance":
            own = pose[0][1] @ (scene.joint.frame[0] if "axis_i" in scene.joint.columns() else np.eye(3))
            assert run.item("joints/joint_force", "tie")[row] == pytest.approx(force @ own, rel=1e-8, abs=1e-6)
            assert run.item("joints/joint_moment", "tie")[row] == pytest.approx(moment @ own, rel=1e-8, abs=1e-6)
        force, moment = load[6:9], load[9:] - np.cross(at[1] - pose[1][0], load[6:9])
        own = pose[moving[-1]][1]
        assert run.item("reactions/force", "on_j")[row] == pytest.approx(force @ own, rel=1e-8, abs=1e-6)
        assert run.item("reactions/moment", "on_j")[row] == pytest.approx(moment @ own, rel=1e-8, abs=1e-6)


@pytest.mark.parametrize("place", PLACES)
@pytest.mark.parametrize("kind", ["revolute", "cylindrical", "screw", "planar", "translational"])
def test_joint_coordinates(gudgeon, kind, place):
    """Angle and displacement of joints that have them, and their rates."""
    scene, states, run, rows = made(gudgeon, kind, place)
    for y, row in zip(states, rows):
        pose, u = scene.pose_of(y), y[14:]
        h = 1e-6
        found = []
        for moment in (0, -h, h):
            d, a, b = scene.joint.spans(*(x for both in moved(pose, u, moment) for x in both))
            found.append((scene.joint.angle(a, b), dot(a[2], d)))
        (angle, way), before, after = found
        if kind != "translational":
            assert abs(np.exp(1j*run.item("joints/angle", "tie")[row]) - np.exp(1j*angle)) < 1e-8
            assert run.item("joints/angular_rate", "tie")[row] == pytest.approx((after[0] - before[0])/(2*h), abs=1e-7)
        if kind in ("cylindrical", "screw", "translational"):
            assert run.item("joints/displacement", "tie")[row] == pytest.approx(way, abs=1e-8)
            assert run.item("joints/sliding_rate", "tie")[row] == pytest.approx((after[1] - before[1])/(2*h), abs=1e-7)


@pytest.mark.parametrize("place", PLACES)
def test_angles_of_the_cross(gudgeon, place):
    """The two angles of a universal joint make the turn of j against i, and their rates its angular velocity."""
    scene, states, run, rows = made(gudgeon, "universal", place)
    start = scene.pose[0][1].T @ scene.pose[1][1]
    arms = [scene.joint.frame[k][:, 2] for k in range(2)]
    for y, row in zip(states, rows):
        pose, u = scene.pose_of(y), y[14:]
        angle, rate = ([run.item(f"joints/{what}_{c}", "tie")[row] for c in "ij"] for what in ("angle", "angular_rate"))
        turned = Rotation.from_rotvec(angle[0]*arms[0]).as_matrix() @ start @ Rotation.from_rotvec(angle[1]*arms[1]).as_matrix()
        assert pose[0][1] @ turned == pytest.approx(pose[1][1], abs=1e-9)
        found = rate[0]*pose[0][1] @ arms[0] + rate[1]*pose[1][1] @ arms[1]
        assert found == pytest.approx(u[9:] - u[3:6], abs=1e-8)


@pytest.mark.parametrize("place", PLACES)
def test_springs(gudgeon, place):
    """A spring with a damper between any points, a coil with a damper about a tilted axis: motion, and what they do to both bodies."""
    scene, states, run, rows = made(gudgeon, "cylindrical", place, True)
    moving = [k for k in range(2) if not scene.is_ground[k]]
    for y, row in zip(states, rows):
        pose, u = scene.pose_of(y), y[14:]
        for n, k in enumerate(moving):
            assert run.read("bodies/position")[row, n] == pytest.approx(pose[k][0], abs=1e-9)
            assert run.read("bodies/angular_velocity")[row, n] == pytest.approx(u[6*k + 3:6*k + 6], abs=1e-8)
        force, at, moment = scene.springs(pose, u)
        axis = (pose[0][1] @ scene.joint.frame[0])[:, 2]
        own = pose[moving[-1]][1]
        p = [r + rot @ s for (r, rot), s in zip(pose, scene.joint.s)]
        assert run.item("forces/force", "wire")[row] == pytest.approx(force, abs=1e-7)
        assert run.item("forces/tension", "wire")[row] == pytest.approx(dot(force, at[1] - at[0])/np.linalg.norm(at[1] - at[0]), abs=1e-7)
        assert run.item("forces/moment", "coil")[row] == pytest.approx(dot(moment, axis), abs=1e-7)
        assert run.item("reactions/force", "wire_j")[row] == pytest.approx(-force @ own, abs=1e-7)
        assert run.item("reactions/moment", "wire_j")[row] == pytest.approx(-np.cross(at[1] - p[1], force) @ own, abs=1e-7)
        assert run.item("reactions/moment", "coil_i")[row] == pytest.approx(moment @ own, abs=1e-7)
        assert run.item("reactions/moment", "coil_j")[row] == pytest.approx(-moment @ own, abs=1e-7)
        assert np.all(run.item("reactions/force", "coil_j")[row] == 0)


@pytest.mark.parametrize("place", PLACES)
@pytest.mark.parametrize("kind", ["revolute", "cylindrical", "planar"])
def test_reference_directions(gudgeon, kind, place):
    """Angles from one direction to the other, neither quite across the axis, as between the x axes of two markers; and the reaction
    along the first."""
    scene = Scene(kind, place)
    random = np.random.default_rng(5)
    given = random.normal(size=(2, 3))
    axes = []
    for x, frame in zip(given, scene.joint.frame):
        z = frame[:, 2]
        x = x - dot(x, z)*z
        axes.append(np.stack([x, np.cross(z, x), z*np.linalg.norm(x)], axis=1)/np.linalg.norm(x))
    directory = scratch()
    extra = " ".join('"' + " ".join(map(repr, x.tolist())) + '"' for x in given)
    axis = scene.joint.columns()["axis_i"]
    text = scene.deck().replace("name i j axis_i\n", "name i j axis_i x_i x_j\n").replace(f"tie p_i p_j {axis}", f"tie p_i p_j {axis} {extra}")
    assert extra in text
    call(gudgeon, "run", written(directory, text), "--out", directory / "out", "--quiet")
    run = Run(directory / "out")
    for row in range(len(run.time)):
        rot = [np.eye(3), np.eye(3)]
        for n, k in enumerate(k for k in range(2) if not scene.is_ground[k]):
            e = run.read("bodies/orientation")[row, n]
            rot[k] = Rotation.from_quat([*e[1:], e[0]]).as_matrix()
        own = rot[0] @ axes[0]
        x = rot[1] @ axes[1][:, 0]
        assert run.item("joints/angle", "tie")[row] == pytest.approx(np.arctan2(dot(x, own[:, 1]), dot(x, own[:, 0])), abs=1e-8)
        for quantity in ("force", "moment"):
            assert run.item(f"joints/joint_{quantity}", "tie")[row] == pytest.approx(run.item(f"joints/{quantity}", "tie")[row] @ own, abs=1e-9)
