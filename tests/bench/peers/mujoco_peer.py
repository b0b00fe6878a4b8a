"""Solves a scene of scenes.py with MuJoCo: python mujoco_peer.py INTEGRATOR STEPS < scene

INTEGRATOR: RK4 or implicitfast, at STEPS equal steps. Loops are closed by `connect`, MuJoCo's soft equality, made as stiff as the
step allows. Prints the processor time of the solution [s], steps, and x, y of the centre of mass of each body at the end [m].
"""

import sys
import time

import mujoco
import numpy as np

GROUND = -1


def words(values):
    """Numbers for an attribute, with all their digits."""
    return " ".join(repr(float(v)) for v in values)


def model_of(lines, integrator, steps):
    """The model as MuJoCo's XML, speeds at the start, and the end of the motion."""
    bodies, joins, extra, sites, gravity, end = [], [], [], {}, (0.0, 0.0), 1.0
    for line in lines:
        word, *rest = line.split()
        v = [float(x) for x in rest]
        if word == "gravity":
            gravity = v
        elif word == "end":
            end = v[0]
        elif word == "pin":
            bodies.append({"parent": int(v[0]), "at": v[1:3], "mass": v[3], "inertia": v[4], "centre": v[5:7], "angle": v[7], "rate": v[8]})
        elif word == "join":
            joins.append((int(v[0]), v[1:3], int(v[3]), v[4:6]))
        elif word == "spring":
            sites.setdefault(int(v[0]), []).append(("si", v[1:3]))
            sites.setdefault(int(v[3]), []).append(("sj", v[4:6]))
            extra.append(f'<tendon><spatial stiffness="{v[6]!r}" springlength="{v[7]!r}"><site site="si"/><site site="sj"/></spatial></tendon>')
        elif word == "torque":
            extra.append(f'<actuator><motor joint="j{int(v[0])}"/></actuator>')
            bodies[int(v[0])]["torque"] = v[1]
        else:
            sys.exit(f"{word}: not for this peer")
    step = end/steps
    text = [f'<mujoco><compiler angle="radian"/><option timestep="{step!r}" gravity="{words([*gravity, 0.0])}" integrator="{integrator}"'
            ' solver="Newton" tolerance="1e-14" iterations="100"><flag contact="disable"/></option><worldbody>']
    text += [f'<site name="{name}" pos="{words([*at, 0.0])}"/>' for name, at in sites.get(GROUND, [])]

    def write(k):
        b = bodies[k]
        half = 0.5*b["angle"]
        text.append(f'<body name="b{k}" pos="{words([*b["at"], 0.0])}" quat="{words([np.cos(half), 0.0, 0.0, np.sin(half)])}">'
                    f'<inertial pos="{words([*b["centre"], 0.0])}" mass="{b["mass"]!r}" diaginertia="{words([b["inertia"]]*3)}"/>'
                    f'<joint name="j{k}" type="hinge" axis="0 0 1"/>')
        text.extend(f'<site name="{name}" pos="{words([*at, 0.0])}"/>' for name, at in sites.get(k, []))
        for child, other in enumerate(bodies):
            if other["parent"] == k:
                write(child)
        text.append("</body>")

    limit = sys.getrecursionlimit()
    sys.setrecursionlimit(max(limit, 10*len(bodies) + 1000))
    for k, b in enumerate(bodies):
        if b["parent"] == GROUND:
            write(k)
    text.append("</worldbody>")
    if joins:
        text.append("<equality>")
        text += [f'<connect body1="b{i}" body2="b{j}" anchor="{words([*at, 0.0])}" solref="{2*step!r} 1" solimp="0.9999 0.9999 0.001"/>'
                 for i, at, j, _ in joins]
        text.append("</equality>")
    text += [*extra, "</mujoco>"]
    return "".join(text), bodies


def main():
    """One run."""
    integrator, steps = sys.argv[1], int(sys.argv[2])
    text, bodies = model_of(sys.stdin.read().splitlines(), integrator, steps)
    model = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(model)
    driven = 0
    for k, b in enumerate(bodies):
        data.qvel[model.joint(f"j{k}").dofadr[0]] = b["rate"]
        if "torque" in b:
            data.ctrl[driven] = b["torque"]
            driven += 1
    begun = time.process_time()
    mujoco.mj_step(model, data, steps)
    cpu = time.process_time() - begun
    if not np.isfinite(data.qpos).all() or data.warning[mujoco.mjtWarning.mjWARN_BADQACC].number > 0:
        sys.exit("the motion grows without bound")
    mujoco.mj_kinematics(model, data)
    print(f"cpu {cpu!r}\nsteps {steps}")
    for k in range(len(bodies)):
        print("centre {!r} {!r}".format(*map(float, data.body(f"b{k}").xipos[:2])))


main()
