"""Solves a scene of scenes.py with Exudyn: python exudyn_peer.py METHOD NUMBER < scene

METHOD: tree, minimal coordinates of a kinematic tree (no loops) by DOPRI5 with NUMBER as the relative and absolute tolerance; or
trapezoidal, redundant coordinates of rigid bodies with joints by the trapezoidal rule of index 2 in NUMBER equal steps. Prints the
processor time of the solution [s], steps, and x, y of the centre of mass of each body at the end [m].
"""

import sys
import time

import exudyn as exu
import exudyn.itemInterface as eii
import numpy as np

GROUND = -1


def scene_of(lines):
    """Bodies, joints, springs and torques of the text, gravity, and the end of the motion."""
    found = {"gravity": (0.0, 0.0), "end": 1.0, "pin": [], "join": [], "spring": [], "torque": []}
    for line in lines:
        word, *rest = line.split()
        v = [float(x) for x in rest]
        if word == "gravity":
            found["gravity"] = v
        elif word == "end":
            found["end"] = v[0]
        elif word in found:
            found[word].append(v)
        else:
            sys.exit(f"{word}: not for this peer")
    return found


def turned(angle, at):
    """A vector turned by an angle."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([c*at[0] - s*at[1], s*at[0] + c*at[1]])


def origins(scene, angles):
    """Angle and origin of each body."""
    found = []
    for pin, angle in zip(scene["pin"], angles):
        turn, origin = found[int(pin[0])] if int(pin[0]) != GROUND else (0.0, np.zeros(2))
        found.append((turn + angle, origin + turned(turn, pin[1:3])))
    return found


def tree(scene, mbs):
    """A kinematic tree; gives what centres of mass to report."""
    pins = scene["pin"]
    n = len(pins)
    if scene["join"] or scene["spring"] or scene["torque"]:
        sys.exit("a tree has no loops here")
    node = mbs.AddNode(eii.NodeGenericODE2(referenceCoordinates=[0.0]*n, initialCoordinates=[p[7] for p in pins],
                                           initialCoordinates_t=[p[8] for p in pins], numberOfODE2Coordinates=n))
    centres = exu.Vector3DList()
    offsets = exu.Vector3DList()
    transformations, inertias = exu.Matrix3DList(), exu.Matrix3DList()
    for p in pins:
        centres.Append([*p[5:7], 0.0])
        offsets.Append([*p[1:3], 0.0])
        transformations.Append(np.eye(3))
        inertias.Append(np.eye(3)*p[4])
    mbs.AddObject(eii.ObjectKinematicTree(
        nodeNumber=node, jointTypes=[exu.JointType.RevoluteZ]*n, linkParents=[int(p[0]) for p in pins],
        jointTransformations=transformations, jointOffsets=offsets, linkInertiasCOM=inertias, linkCOMs=centres,
        linkMasses=[p[3] for p in pins], gravity=[*scene["gravity"], 0.0]))

    def report():
        q = np.atleast_1d(mbs.GetNodeOutput(node, exu.OutputVariableType.Coordinates))
        return [origin + turned(turn, p[5:7]) for (turn, origin), p in zip(origins(scene, q), pins)]
    return report


def redundant(scene, mbs):
    """Rigid bodies and joints; gives what centres of mass to report."""
    pins = scene["pin"]
    ground = mbs.AddObject(eii.ObjectGround())
    start = origins(scene, [p[7] for p in pins])
    rates = []
    nodes, bodies = [], []
    speeds = []
    for p, (turn, origin) in zip(pins, start):
        parent = int(p[0])
        rate = p[8] + (rates[parent] if parent != GROUND else 0.0)
        base = np.zeros(2)
        if parent != GROUND:
            across = turned(start[parent][0], p[1:3])
            base = speeds[parent] + rates[parent]*np.array([-across[1], across[0]])
        rates.append(rate)
        speeds.append(base)
        arm = turned(turn, p[5:7])
        centre = origin + arm
        velocity = base + rate*np.array([-arm[1], arm[0]])
        nodes.append(mbs.AddNode(eii.NodeRigidBody2D(referenceCoordinates=[*centre, turn], initialVelocities=[*velocity, rate])))
        bodies.append(mbs.AddObject(eii.ObjectRigidBody2D(nodeNumber=nodes[-1], physicsMass=p[3], physicsInertia=p[4])))
        weight = mbs.AddMarker(eii.MarkerBodyMass(bodyNumber=bodies[-1]))
        mbs.AddLoad(eii.LoadMassProportional(markerNumber=weight, loadVector=[*scene["gravity"], 0.0]))

    def marker(k, at):
        k = int(k)
        place = [*at, 0.0] if k == GROUND else [at[0] - pins[k][5], at[1] - pins[k][6], 0.0]
        return mbs.AddMarker(eii.MarkerBodyPosition(bodyNumber=ground if k == GROUND else bodies[k], localPosition=place))

    for k, p in enumerate(pins):
        mbs.AddObject(eii.ObjectJointRevolute2D(markerNumbers=[marker(p[0], p[1:3]), marker(k, (0.0, 0.0))]))
    for j in scene["join"]:
        mbs.AddObject(eii.ObjectJointRevolute2D(markerNumbers=[marker(j[0], j[1:3]), marker(j[3], j[4:6])]))
    for s in scene["spring"]:
        mbs.AddObject(eii.ObjectConnectorSpringDamper(markerNumbers=[marker(s[0], s[1:3]), marker(s[3], s[4:6])],
                                                      stiffness=s[6], referenceLength=s[7]))
    for t in scene["torque"]:
        turning = mbs.AddMarker(eii.MarkerBodyRigid(bodyNumber=bodies[int(t[0])]))
        mbs.AddLoad(eii.LoadTorqueVector(markerNumber=turning, loadVector=[0.0, 0.0, t[1]]))
    return lambda: [mbs.GetNodeOutput(node, exu.OutputVariableType.Position)[:2] for node in nodes]


def main():
    """One run."""
    method, number = sys.argv[1], float(sys.argv[2])
    scene = scene_of(sys.stdin.read().splitlines())
    system = exu.SystemContainer()
    mbs = system.AddSystem()
    report = (tree if method == "tree" else redundant)(scene, mbs)
    mbs.Assemble()
    settings = exu.SimulationSettings()
    settings.timeIntegration.endTime = scene["end"]
    settings.timeIntegration.verboseMode = 0
    settings.solutionSettings.writeSolutionToFile = False
    settings.solutionSettings.sensorsWritePeriod = scene["end"]
    settings.displayComputationTime = False
    if method == "tree":
        settings.timeIntegration.numberOfSteps = 10  # the longest step is a tenth of the motion
        settings.timeIntegration.relativeTolerance = number
        settings.timeIntegration.absoluteTolerance = number
        solver = exu.DynamicSolverType.DOPRI5
    else:
        settings.timeIntegration.numberOfSteps = int(number)
        settings.timeIntegration.newton.useModifiedNewton = True
        settings.linearSolverType = exu.LinearSolverType.EigenSparse if len(scene["pin"]) > 20 else exu.LinearSolverType.EXUdense
        solver = exu.DynamicSolverType.TrapezoidalIndex2
    begun = time.process_time()
    done = mbs.SolveDynamic(settings, solverType=solver)
    cpu = time.process_time() - begun
    if not done:
        sys.exit("the solver gave up")
    print(f"cpu {cpu!r}\nsteps {settings.timeIntegration.numberOfSteps}")
    for x, y in report():
        print(f"centre {float(x)!r} {float(y)!r}")


main()
