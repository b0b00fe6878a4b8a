"""Sliders loose in their guides, alone and beside another loose joint: independent values, limits, invariants, the ledger."""

import numpy as np
import pytest
from support import ROOT, Run, assert_close, call, changed, scratch, written

TRANSLATIONAL = ROOT / "inputs" / "slider_crank_translational.deck"
TWO_JOINTS = ROOT / "inputs" / "slider_crank_two_joints.deck"
DRY = ROOT / "inputs" / "slider_crank_dry.deck"

# by options of the deck: label, onset [s], impact speed [m/s], peak force [N], duration [s] of the first contacts, from an
# independent integration: two coordinates (rod and slider), scipy's DOP853 at 1e-12, located events
IMPACTS = {
    "friction=0.05": (
        ("C_upper", 8.1379301038363e-04, 1.765145468, 4687.064352, 0.0001664776259),
        ("D_upper", 8.1379301038363e-04, 1.765145468, 5089.362905, 0.0001724156298),
        ("C_upper", 1.6057420180792e-03, 1.471965869, 3760.052597, 0.0001913514784),
        ("D_upper", 1.6436059065136e-03, 1.614205109, 5419.793705, 0.0001695721578),
        ("C_upper", 2.2482281782965e-03, 0.7003410181, 1626.390175, 0.0001955555036),
        ("D_upper", 2.9017545231124e-03, 0.9133506588, 1829.502636, 0.0001762629646),
        ("A_lower", 3.8262030532490e-03, 1.983926093, 4937.119279, 0.0001543264101),
    ),
    "friction=0.1 gap=0.1mm": (
        ("C_upper", 4.6913878270882e-04, 0.6302275012, 1533.602731, 0.0002154332916),
        ("D_upper", 4.6913878270882e-04, 0.6302275012, 1831.432387, 0.0002302888716),
        ("C_upper", 9.1014365284186e-04, 0.4630027394, 1410.762907, 0.001554381736),
        ("D_upper", 9.5043558339896e-04, 0.5448435966, 2190.583303, 0.0002369305474),
        ("D_upper", 1.3699320501151e-03, 0.5748569038, 2155.609104, 0.0002352857917),
        ("C_upper", 2.7326599673383e-03, 0.1273829995, 229.1003378, 0.0002544830048),
    ),
    "friction=0.05 law=exact restitution=0.7 gap=0.2mm": (
        ("C_upper", 5.9364117417357e-04, 0.9875061775, 2337.09065, 0.0002123792831),
        ("D_upper", 5.9364117417357e-04, 0.9875061775, 2538.24163, 0.0002200070822),
    ),
    "friction=0.03 law=hertz gap=0.2mm": (
        ("C_upper", 5.9364117417357e-04, 0.9875061775, 2699.866328, 0.0001893444739),
        ("D_upper", 5.9364117417357e-04, 0.9875061775, 2844.392676, 0.0001933519753),
        ("C_upper", 1.2080251068698e-03, 0.9784898394, 2898.219515, 0.000203741686),
        ("D_upper", 1.2265631908034e-03, 1.020443646, 3548.536377, 0.0001920008154),
        ("C_upper", 1.7411737595173e-03, 0.7423011175, 2100.27355, 0.0001958103448),
        ("D_upper", 1.9003099584261e-03, 1.417412107, 3853.743926, 0.0001660989197),
    ),
}

# A slider that nothing but its guide holds; the guide is a body of its own, or the ground.
SLIDER = """deck = 1
[scene]
space   = planar
gravity = 0 0 m/s^2
[parameters]
faces    = corners
friction = 0
[bodies]
name     mass[kg]   inertia[kg.m^2]   x[mm]   y[mm]   angle[deg]   vx[m/s]   vy[m/s]   omega[rad/s]
slider   {mass}     1e-3              {x}     0       {angle}      {vx}      {vy}      {omega}
rail     3          2e-2              0       0       0            0         0         0
[points]
name     body       xi[mm]   eta[mm]
track    {guide}    0        0
pin      slider     0        0
[material]
name     young[GPa]   poisson   density[kg/m^3]
steel    207          0.3       7850
[clearance.translational]
name    guide   slider  axis  length[mm]  height[mm]  width[mm]  gap[mm]  guide_start[mm]  guide_end[mm]  corner_radius[mm]  material  law    face_law  faces    friction
guide   track   pin     x     50          50          50         {gap}    {start}          {end}          1                  steel     dry    face      {{faces}}  ambrosio
[contact.lankarani_nikravesh]
name   restitution
dry    0.9
[contact.plane_face]
name   restitution
face   0.9
[friction.ambrosio]
name       coefficient   v0[m/s]   v1[m/s]
ambrosio   {{friction}}  1e-4      1e-3
[analysis.dynamic]
start     = given
overlap   = {overlap}
end       = {until} ms
method    = verner
tolerance = 1e-11
ledger    = on
[output]
every     = {until}e-3 ms
"""


def alone(program, *options, **numbers):
    """A run of the slider that nothing else holds."""
    numbers = dict(mass=1, x=0, angle=0, vx=0, vy=0, omega=0, guide="ground", gap=0.1, start=0, end=0, overlap="error",
                   until=2) | numbers
    return finished(program, written(scratch(), SLIDER.format(**numbers)), *options)


def finished(program, deck, *options):
    """A run with all channels and without figures; options are words, `--set` goes before those with a `=`."""
    directory = scratch()
    text = changed(deck.read_text(), "output", figures=None, channels=None)
    words = [word for option in options for word in (("--set", option) if "=" in option else (option,))]
    call(program, "run", written(directory, text), "--out", directory / "out", "--quiet", *words)
    return Run(directory / "out")


def closes(run):
    """The residual of the ledger stays below 1e-6 of the energy exchanged."""
    return run.summary["energy_residual_max"] < 1e-6 * run.summary["energy_max"]


def same_impacts(one, other, n, relative=1e-9):
    """The first n contacts of two runs are the same."""
    for field in ("time", "impact_speed", "peak_force", "duration"):
        assert_close(one.contacts[field][:n], other.contacts[field][:n], relative=relative, what=field)


@pytest.mark.parametrize("options", IMPACTS)
def test_impacts_of_an_independent_solution(gudgeon, options):
    """Corner after corner: onset, speed, peak and duration."""
    run = finished(gudgeon, TRANSLATIONAL, "--tolerance", "1e-11", *options.split())
    for label, onset, speed, peak, duration in IMPACTS[options]:
        rows = run.contacts[[text.decode().strip() == label for text in run.contacts["contact"]]]
        row = rows[np.argmin(np.abs(rows["time"] - onset))]
        assert row["item"].decode().strip() == "guide"
        assert row["time"] == pytest.approx(onset, abs=1e-10)
        assert [row["impact_speed"], row["peak_force"], row["duration"]] == pytest.approx([speed, peak, duration], rel=1e-7)


@pytest.mark.parametrize("faces, tolerance", [("corners", "1e-8"), ("book", "1e-8"), ("blend", "1e-10"), ("foundation", "1e-8")])
@pytest.mark.parametrize("friction", ["0", "0.05"])
def test_ledger_closes_with_faces(gudgeon, faces, tolerance, friction):
    """Every way of treating faces, also that whose force and energy jump."""
    run = finished(gudgeon, TRANSLATIONAL, f"faces={faces}", f"friction={friction}", "--tolerance", tolerance)
    assert len(run.contacts) > 5
    assert closes(run), run.summary["energy_residual_relative"]


@pytest.mark.parametrize("faces", ["corners", "book", "blend", "foundation"])
def test_face_of_two_equal_corners(gudgeon, faces):
    """A slider that hits with a whole side: two corners of Hertz' kind, or one face with K = a/(0.4732 sigma), in closed form."""
    mass, speed = 1.0, 0.1
    run = alone(gudgeon, f"faces={faces}", vy=speed, until=3)
    sigma = 2.0 * (1.0 - 0.3**2) / 207e9
    first = run.contacts[:2]
    assert sorted(text.decode().strip() for text in first["contact"]) == ["C_upper", "D_upper"]
    assert_close(first["time"], np.full(2, 1e-3), relative=1e-9, what="onset")
    elastic = finished(gudgeon, written(scratch(), SLIDER.format(
        mass=1, x=0, angle=0, vx=0, vy=speed, omega=0, guide="ground", gap=0.1, start=0, end=0, overlap="error", until=3,
    ).replace("dry    0.9", "dry    1").replace("face   0.9", "face   1")), f"faces={faces}").contacts[:2]
    if faces == "corners":
        stiffness = 2.0 * 4.0 / (3.0 * sigma) * np.sqrt(1e-3)
        peak = stiffness * (1.25 * mass * speed**2 / stiffness) ** 0.6
    else:
        side = 0.05
        mean = 2.0 / np.pi * (2.0 * np.arcsinh(1.0) - (2.0**1.5 - 2.0) / 3.0)
        peak = speed * np.sqrt(mass * side / (mean * sigma))
    assert_close(elastic["peak_force"], np.full(2, peak / 2.0), relative=1e-7, what="peak force")
    assert_close(elastic["release_speed"], np.full(2, speed), relative=1e-7, what="rebound")
    assert np.all(first["release_speed"] < elastic["release_speed"])


@pytest.mark.parametrize("faces", ["corners", "book", "blend", "foundation"])
@pytest.mark.parametrize("friction", ["0", "0.1"])
def test_slider_leaves_its_guide(gudgeon, faces, friction):
    """Corners that press go over the end: their contacts end there, and what they stored is booked as lost."""
    text = SLIDER.format(mass=1, x=0, angle=0, vx=1, vy=0, omega=0, guide="ground", gap=0.02, start=-100, end=60,
                         overlap="error", until=150)
    for old, new in (("gravity = 0 0", "gravity = 0 -9.81"), ("1e-11", "1e-9"), ("dry    0.9", "dry    0.3"), ("face   0.9", "face   0.3")):
        text = text.replace(old, new)
    deck = written(scratch(), text)
    run = finished(gudgeon, deck, f"faces={faces}", f"friction={friction}")
    x, angle = run.item("bodies/position", "slider")[:, 0], run.item("bodies/angle", "slider")
    last = run.contacts[[text.decode().strip() == "B_lower" for text in run.contacts["contact"]]][-1]
    end = last["time"] + last["duration"]
    corner = np.interp(end, run.time, x + 0.025 * np.cos(angle) + 0.025 * np.sin(angle))
    assert corner < 0.06 + 1e-6
    if (faces, friction) != ("book", "0.1"):  # its switch feeds energy: the slider hops with it
        assert corner == pytest.approx(0.06, abs=1e-6)
    # the normal speed there: with faces across the guide, without them along it, past the front
    assert abs(last["release_speed"]) == pytest.approx(1.0, abs=0.1) if faces == "corners" else abs(last["release_speed"]) < 0.1
    state = run.read("clearances/contacts/state")
    assert state[-1].sum() == 0.0 and state[1:].any()
    assert closes(run), run.summary["energy_residual_relative"]


def test_slider_enters_its_guide(gudgeon):
    """A corner that comes at the front of the guide, 0.8 mm beyond its surface, hits it with the speed along the guide."""
    run = alone(gudgeon, x=-40, angle=2, vx=2, start=0, end=200, until=12, gap=0.05, overlap="error")
    assert len(run.contacts) > 0
    first = run.contacts[0]
    assert first["contact"].decode().strip() == "C_upper"
    reach = 0.025 * np.sqrt(2.0) * np.cos(np.pi / 4.0 + np.radians(2))
    assert first["time"] == pytest.approx((0.04 - reach) / 2.0, rel=1e-9)
    assert first["impact_speed"] == pytest.approx(2.0, rel=1e-9)
    assert run.item("bodies/velocity", "slider")[-1, 0] < 0.0  # it is thrown back
    assert run.read("energy/dissipated_contact").min() >= -1e-9
    assert closes(run), run.summary["energy_residual_relative"]


@pytest.mark.parametrize("height", [0.6, 5.0])
def test_front_of_a_guide(gudgeon, height):
    """A block that flies at the mouth too high, by 0.5 or 4.9 mm, in closed form: its upper corner hits the front
    elastically, off its centre by half its height: an impact of the mass 1/(1/m + h^2/J), after which energy and momentum are what they were."""
    run = finished(gudgeon, written(scratch(), planar_beside(height)))
    first = run.contacts[0]
    assert first["contact"].decode().strip() == "C_upper"
    assert first["time"] == pytest.approx(0.04, rel=1e-9)
    assert first["impact_speed"] == pytest.approx(2.0, rel=1e-9)
    mass = 1.0 / (1.0 + 0.01**2 / 1e-3)  # of 1 kg and 1e-3 kg m^2, 10 mm above the centre
    stiffness = 4.0 / 3.0 * 207e9 / (2.0 * (1.0 - 0.3**2)) * np.sqrt(1e-3)
    assert first["peak_force"] == pytest.approx(stiffness * (1.25 * mass * 4.0 / stiffness) ** 0.6, rel=3e-3)
    velocity, turning = run.item("bodies/velocity", "block")[-1], run.item("bodies/angular_velocity", "block").reshape(-1)[-1]
    assert velocity[0] == pytest.approx(2.0 - 2.0 * mass * 2.0, rel=3e-3)
    assert abs(turning) == pytest.approx(2.0 * mass * 2.0 * 0.01 / 1e-3, rel=3e-3)
    assert 0.5 * (velocity @ velocity) + 0.5e-3 * turning**2 == pytest.approx(2.0, rel=1e-6)
    assert np.abs(run.read("energy/dissipated_contact")).max() < 1e-6
    assert closes(run)


def test_corner_that_goes_round_the_edge_of_a_front(gudgeon):
    """At 2 m/s steel gives by the 0.2 mm that the block is too high: the force turns from along the guide to across it, and the energy stays."""
    run = finished(gudgeon, written(scratch(), planar_beside(0.3).replace("every = 1 ms", "every = 10 us")), "--tolerance", "1e-10")
    along, across = np.abs(run.item("clearances/force", "guide")).max(axis=0)
    assert along > 1e4 and across > 1e4, (along, across)
    assert np.abs(run.read("energy/dissipated_contact")).max() < 1e-6
    total = (run.read("energy/kinetic") + run.read("energy/elastic")).reshape(-1)
    assert total.min() > 1.99999 and total.max() < 2.00001
    assert closes(run), run.summary["energy_residual_relative"]


def test_energy_that_faces_make_at_the_mouth_ends_the_run(gudgeon):
    """With faces there is no front: a corner 5 mm in the surface begins there with the energy of that, far beyond what moves."""
    text = planar_beside(5.0)
    text = text.replace("guide_end[mm]  ", "guide_end[mm] faces face_law width[mm] ").replace("200            ", "200 blend face 30 ")
    text += "[contact.plane_face]\nname restitution\nface 0.9\n"
    directory = scratch()
    done = call(gudgeon, "run", written(directory, text), "--out", directory / "out", "--quiet", expect=5)
    assert "a contact with initial overlap created" in done.stderr and "guard 'energy'" in done.stderr


def test_moving_guide_is_a_fixed_one_with_the_reduced_mass(gudgeon):
    """A free guide of 3 kg hit squarely by 1 kg: the impact of 0.75 kg on a fixed one."""
    moving = alone(gudgeon, vy=0.2, guide="rail", until=1)
    fixed = alone(gudgeon, vy=0.2, mass=0.75, until=1)
    assert len(fixed.contacts) >= 2
    for field in ("time", "impact_speed", "peak_force", "duration", "release_speed"):
        assert_close(moving.contacts[field][:2], fixed.contacts[field][:2], relative=1e-8, what=field)


@pytest.mark.parametrize("faces", ["corners", "book", "blend", "foundation"])
def test_moving_guide_keeps_momentum(gudgeon, faces):
    """A slider that tumbles in a free guide with friction: momentum and moment of momentum stay, energy is lost as booked."""
    run = alone(gudgeon, f"faces={faces}", "friction=0.1", vx=1, vy=0.3, omega=4, guide="rail", until=5)
    assert len(run.contacts) >= 4
    p, spin = np.zeros((len(run.time), 2)), np.zeros(len(run.time))
    for body, mass, inertia in (("slider", 1.0, 1e-3), ("rail", 3.0, 2e-2)):
        r, v = run.item("bodies/position", body)[:, :2], run.item("bodies/velocity", body)[:, :2]
        p += mass * v
        spin += mass * (r[:, 0] * v[:, 1] - r[:, 1] * v[:, 0]) + inertia * run.item("bodies/angular_velocity", body).reshape(-1)
    assert_close(p, np.broadcast_to([1.0, 0.3], p.shape), absolute=1e-10, what="momentum")
    assert_close(spin, np.full(len(spin), 4e-3), absolute=1e-10, what="moment of momentum")
    assert closes(run), run.summary["energy_residual_relative"]


def test_two_opposite_corners_at_one_instant(gudgeon):
    """A slider that turns about its centre is stopped by two corners on opposite sides: a couple, and no force."""
    run = alone(gudgeon, omega=10, until=1)
    first = run.contacts[:2]
    assert sorted(text.decode().strip() for text in first["contact"]) == ["A_lower", "C_upper"]
    turn = np.arcsin((0.025 + 1e-4) / (0.025 * np.sqrt(2.0))) - np.pi / 4.0  # a corner reaches half the height and the gap
    assert_close(first["time"], np.full(2, turn / 10.0), relative=1e-9, what="onset")
    assert first["peak_force"][0] == pytest.approx(first["peak_force"][1], rel=1e-9)
    force, moment = run.item("clearances/force", "guide"), run.item("clearances/moment", "guide").reshape(-1)
    assert np.abs(force).max() < 1e-9 * np.abs(moment).max() / 0.025
    assert moment.min() < -1.0
    assert closes(run)


def test_clamped_between_both_surfaces(gudgeon):
    """A slider askew and larger than its guide, preloaded: an error that says so, or it is pressed back by both at once."""
    directory = scratch()
    deck = written(directory, SLIDER.format(mass=1, x=0, angle=0.3, vx=0, vy=0, omega=0, guide="ground", gap=0.05, start=0, end=0,
                                            overlap="error", until=2))
    done = call(gudgeon, "run", deck, "--out", directory / "out", "--quiet", expect=None)
    assert done.returncode != 0 and "initial overlap: joint 'guide'" in done.stderr
    run = alone(gudgeon, angle=0.3, gap=0.05, overlap="preload", until=2)
    assert run.read("clearances/contacts/state")[0].sum() == 2.0
    moment = run.item("clearances/moment", "guide").reshape(-1)
    depth = 0.025 * np.sqrt(2.0) * np.sin(np.pi / 4.0 + np.radians(0.3)) - 0.025 - 5e-5
    stiffness = 4.0 / 3.0 * 207e9 / (2.0 * (1.0 - 0.3**2)) * np.sqrt(1e-3)
    arm = 0.025 * np.sqrt(2.0) * np.cos(np.pi / 4.0 + np.radians(0.3))
    assert moment[0] == pytest.approx(-2.0 * stiffness * depth**1.5 * arm, rel=1e-9)
    assert np.abs(run.item("bodies/position", "slider")).max() < 1e-12
    assert closes(run)


def test_gaps_that_differ(gudgeon):
    """The gap of each side is its own."""
    text = SLIDER.format(mass=1, x=0, angle=0, vx=0, vy=-0.1, omega=0, guide="ground", gap="0.1", start=0, end=0, overlap="error",
                         until=12)
    text = text.replace("gap[mm]", "gap_upper[mm]  gap_lower[mm]").replace("50         0.1 ", "50         0.3  0.2 ")
    run = finished(gudgeon, written(scratch(), text))
    rows = run.contacts
    assert sorted(text.decode().strip() for text in rows["contact"][:2]) == ["A_lower", "B_lower"]
    assert_close(rows["time"][:2], np.full(2, 2e-3), relative=1e-9, what="lower")
    assert sorted(text.decode().strip() for text in rows["contact"][2:4]) == ["C_upper", "D_upper"]
    flight = rows["time"][2] - rows["time"][0] - rows["duration"][0]
    assert flight == pytest.approx(5e-4 / rows["release_speed"][0], rel=1e-8)


def test_ideal_level_is_the_joint(gudgeon):
    """Without clearance the guide is joint.translational, to round-off."""
    text = TRANSLATIONAL.read_text()
    level = text.replace("steel      clearance   {law}", "steel      ideal       {law}")
    assert level != text
    begin = text.index("[clearance.translational]")
    joint = (text[:begin] + "[joint.translational]\nname i j axis\nguide main pin x\n\n[contact."
             + text[begin:].split("[contact.", 1)[1]).replace(" guide.penetration", "")
    runs = [finished(gudgeon, written(scratch(), deck), "--tolerance", "1e-10") for deck in (level, joint)]
    for what, name in (("bodies/position", "slider"), ("bodies/velocity", "slider"), ("drivers/moment", "motor")):
        one, other = (run.item(what, name) for run in runs)
        assert_close(one, other, absolute=1e-12 * np.abs(other).max(), what=what)


def test_two_loose_joints_are_each_alone(gudgeon):
    """With one of them ideal the mechanism of two loose joints is that of the other."""
    pin = finished(gudgeon, TWO_JOINTS, "guide=ideal", "--tolerance", "1e-10")
    same_impacts(pin, finished(gudgeon, DRY, "c=0.2mm", "friction=0.03", "--tolerance", "1e-10"), 4)
    guide = finished(gudgeon, TWO_JOINTS, "gudgeon=ideal", "--tolerance", "1e-10")
    same_impacts(guide, finished(gudgeon, TRANSLATIONAL, "gap=0.1mm", "friction=0.03", "--tolerance", "1e-10"), 4)


def test_two_loose_joints_with_springs(gudgeon):
    """Loose pin, loose guide, motor, gravity, a spring with a damper and one that turns: both joints are hit, the ledger closes."""
    text = TWO_JOINTS.read_text().replace("gravity  = 0 0", "gravity  = 0 -9.81")
    text = text.replace("[clearance.revolute]", "[force.spring]\nname i j stiffness damping free_length\n"
                        "s main pin 2e3N/m 3N.s/m 100mm\n\n[force.torsion_spring]\nname i j stiffness damping\n"
                        "t crank rod 0.5N.m/rad 1e-4N.m.s/rad\n\n[clearance.revolute]")
    run = finished(gudgeon, written(scratch(), text), "--tolerance", "1e-9")
    assert {text.decode().strip() for text in run.contacts["item"]} == {"gudgeon", "guide"}
    assert run.read("energy/elastic").max() > 1.0
    assert run.read("energy/dissipated_damper").reshape(-1)[-1] > 0.0
    assert closes(run), run.summary["energy_residual_relative"]


def test_eccentricity_is_that_of_the_slider(gudgeon):
    """The centre of the slider from the guide's line is its height above it, for a guide along x through the origin."""
    run = finished(gudgeon, TRANSLATIONAL, "friction=0.05")
    path = run.item("clearances/eccentricity", "guide")
    assert_close(path[:, 1], run.item("bodies/position", "slider")[:, 1], absolute=1e-15, what="height")
    assert np.abs(path[:, 0]).max() == 0.0
    assert 5e-4 < np.abs(path[:, 1]).max() < 7e-4

BESIDE = """deck = 1
[scene]
title = "a block flies at the mouth of a guide, too high"
{space}
[bodies]
{bodies}
[points]
name   body    {xi}
main   ground  0
core   block   0
[material]
name   young[GPa]   poisson
steel  207          0.3
[contact.hertz]
name
hertz
[clearance.translational]
name   guide  slider  {axis}  length[mm]  height[mm]  gap[mm]  corner_radius[mm]  material  law    guide_start[mm]  guide_end[mm]  {more}
guide  main   core    {along} 40          20          0.1      1                  steel     hertz  0                200            {width}
[analysis.dynamic]
start = given
end   = 45 ms
[output]
every = 1 ms
"""


def planar_beside(height):
    """The deck in the plane: a block that flies along the guide's line, some mm above it."""
    return BESIDE.format(space="", bodies=f"name mass[kg] inertia[kg.m^2] x[mm] y[mm] vx[m/s]\nblock 1 1e-3 -100 {height} 2",
                         xi="xi[m] eta[m]", axis="axis", along="x", more="", width="").replace("  0\n", "  0 0\n")


@pytest.mark.parametrize("faces", [False, True], ids=["corners", "faces"])
@pytest.mark.parametrize("space", ["plane", "space"])
def test_no_surface_beyond_the_ends_of_a_guide(gudgeon, space, faces):
    """Beyond the ends no surface is there to be penetrated; a corner that comes at the mouth 0.2 mm too high hits the front, and with faces, which have none, is told
    of, with its clearance."""
    if faces and space == "space":
        pytest.skip("faces are of the plane")
    if space == "plane":
        text = planar_beside(0.3)
        if faces:
            text = text.replace("guide_end[mm]  ", "guide_end[mm] faces face_law width[mm] ").replace("200            ", "200 book face 30 ")
            text += "[contact.plane_face]\nname restitution\nface 0.9\n"
    else:
        text = BESIDE.format(space="space = spatial", xi="xi[m]", axis="axis_i width_axis", along='"1 0 0" "0 0 1"', more="width[mm]", width="30",
                             bodies="name mass[kg] ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2] x[mm] y[mm] vx[m/s]\nblock 1 1e-3 1e-3 1e-3 -100 0.3 2")
    run = finished(gudgeon, written(scratch(), text))
    depth, state = run.read("clearances/contacts/penetration"), run.read("clearances/contacts/state")
    entry = 0.04  # 80 mm at 2 m/s bring the front corners to the mouth
    assert np.abs(depth[run.time < entry]).max() < 1e-17  # round-off of a penetration
    assert np.abs(depth[state == 0]).max() < 1e-17
    assert run.contacts["time"][0] == pytest.approx(entry, rel=1e-9)
    if faces:
        assert run.contacts["peak_penetration"][0] == pytest.approx(2e-4, rel=1e-6)
        assert any("more than the clearance, 0.1 mm" in words for words in run.summary["warnings"])
    else:
        assert run.contacts["impact_speed"][0] == pytest.approx(2.0, rel=1e-9)
        assert np.abs(run.read("energy/dissipated_contact")).max() < 1e-6


def test_guide_shorter_than_its_slider(gudgeon):
    """No contact would ever hold both ends of the slider: refused as in space."""
    text = planar_beside(0.3).replace("200    ", "39.9    ")
    done = call(gudgeon, "check", written(scratch(), text), expect=3)
    assert "0.0399 m long, shorter than the block" in done.stderr and "^^^^" in done.stderr
