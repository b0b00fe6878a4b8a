"""Requests: channels of points, motion seen from bodies, reactions at points, expressions over channels. Against closed forms."""

import functools
import json

import h5py
import numpy as np
import pytest
from support import ROOT, assert_close, call, changed, scratch, written

# A four-bar whose crank turns at 7 rad/s; the tracer is beside the line of the coupler. In the plane, or about z in space.
FOUR_BAR = """deck = 1
[scene]
gravity = 0 0 m/s^2
SPACE
[bodies]
name     mass[kg] INERTIA        x                     y            angle[rad] AXIS
crank    1.0      INE3           0.1m                  0m           0 AX
coupler  2.25     INE20          {0.5*(0.2m + 0.225m)} {0.5*sqrt((0.4m)^2 - (0.025m)^2)} ANG1 AX
rocker   2.0      INE13          {0.5*(0.25m + 0.225m)} {0.5*sqrt((0.4m)^2 - (0.025m)^2)} ANG2 AX
[points]
name      body     xi[m]  eta[m]
base      ground   0      0
far       ground   0.25   0
heel      crank   -0.1    0
throw     crank    0.1    0
near_end  coupler -0.2    0
far_end   coupler  0.2    0
tracer    coupler  0.05   0.11
foot      rocker  -0.2    0
head      rocker   0.2    0
[joint.revolute]
name      i          j
main      base       heel
crankpin  throw      near_end
top       far_end    head
pivot     far        foot
[driver.speed]
name   joint  speed
motor  main   7rad/s
[request.motion]
name     point    from     frame    observer
from_c   tracer   -        crank    frame
accel    tracer   -        crank    world
gap      tracer   head     ground   frame
[request.reaction]
name  joint     on  point   frame
heel_end  crankpin  j   tracer  ground
head_end  top       i   tracer  ground
felt_end  crankpin  j   tracer  coupler
[analysis.kinematic]
end = 1 s
[output]
every = 10 ms
channels = heel_end.* head_end.* felt_end.* coupler.* tracer.* far.position from_c.* accel.* gap.*
"""


def four_bar(is_spatial):
    """The deck in the plane, or the same in space."""
    angles = ["{atan2(sqrt((0.4m)^2 - (0.025m)^2), 0.225m - 0.2m)}", "{atan2(sqrt((0.4m)^2 - (0.025m)^2), 0.225m - 0.25m)}"]
    if not is_spatial:
        text = FOUR_BAR.replace("SPACE", "").replace(" AXIS", "").replace(" AX\n", "\n").replace("INERTIA", "inertia[kg.m^2]")
        for word, value in (("INE3", "0.3"), ("INE20", "2.0"), ("INE13", "1.35")):
            text = text.replace(word, value)
    else:
        text = FOUR_BAR.replace("SPACE", "space = spatial").replace("0 0 m/s^2", "0 0 0 m/s^2").replace("AXIS", "axis")
        text = text.replace(" AX\n", ' "0 0 1"\n').replace("INERTIA", "ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2]")
        for word, value in (("INE3", "0.2 0.2 0.3"), ("INE20", "1.5 1.2 2.0"), ("INE13", "1 1 1.35")):
            text = text.replace(word, value)
        text = text.replace("name      i          j\nmain      base       heel\ncrankpin  throw      near_end\n"
                            "top       far_end    head\npivot     far        foot",
                            'name      i          j        axis_i\nmain      base       heel     "0 0 1"\n'
                            'crankpin  throw      near_end "0 0 1"\ntop       far_end    head     "0 0 1"\n'
                            'pivot     far        foot     "0 0 1"')
    return text.replace("ANG1", angles[0]).replace("ANG2", angles[1])


@functools.lru_cache(maxsize=None)
def run(program, text, *options, expect=0):
    """A run: its directory and its file."""
    directory = scratch()
    done = call(program, "run", written(directory, text), "--out", directory / "o", *options, expect=expect)
    return directory / "o", (h5py.File(directory / "o" / "run.h5") if expect == 0 else None), done


def column(file, room, quantity, name):
    """The history of a quantity of an item."""
    names = [n.decode() for n in file[room]["names"][:]]
    return file[room][quantity][:, names.index(name)]


def tracer_of(t, omega=7.0):
    """The tracer, the crank's pin and the rocker's head, by the intersection of two circles."""
    crank = 0.2 * np.exp(1j * omega * t)
    to_far = 0.25 - crank
    half = np.abs(to_far) / 2
    head = crank + to_far / 2 + 1j * to_far / np.abs(to_far) * np.sqrt(0.4**2 - half**2)
    along = (head - crank) / 0.4
    return crank + along * (0.2 + 0.05 + 0.11j), crank, head


def derivatives(f, t, h=2e-4):
    """f and its first two derivatives by central differences of order eight."""
    w1 = np.array([1 / 280, -4 / 105, 1 / 5, -4 / 5, 0, 4 / 5, -1 / 5, 4 / 105, -1 / 280])
    w2 = np.array([-1 / 560, 8 / 315, -1 / 5, 8 / 5, -205 / 72, 8 / 5, -1 / 5, 8 / 315, -1 / 560])
    values = np.array([f(t + k * h) for k in range(-4, 5)])
    return f(t), np.tensordot(w1, values, 1) / h, np.tensordot(w2, values, 1) / h**2


@pytest.mark.parametrize("is_spatial", [False, True])
def test_coupler_curve(gudgeon, is_spatial):
    """The tracer's path in the world, as the crank sees it, as an accelerometer on the crank reads, and from the rocker's head."""
    _, file, _ = run(gudgeon, four_bar(is_spatial))
    t = file["time"][:]
    turn = lambda s: np.exp(-7j * s)
    curves = {
        ("points", "tracer"): derivatives(lambda s: tracer_of(s)[0], t),
        ("motions", "from_c"): derivatives(lambda s: (tracer_of(s)[0] - tracer_of(s)[1] / 2) * turn(s), t),
        ("motions", "accel"): [x * turn(t) for x in derivatives(lambda s: tracer_of(s)[0] - tracer_of(s)[1] / 2, t)],
        ("motions", "gap"): derivatives(lambda s: tracer_of(s)[0] - tracer_of(s)[2], t),
    }
    for (room, name), wanted in curves.items():
        for quantity, x, error in zip(("position", "velocity", "acceleration"), wanted, (1e-12, 1e-10, 1e-6)):
            got = column(file, room, quantity, name)
            assert_close(got[:, 0], x.real, error, what=f"{name}.{quantity}.x")
            assert_close(got[:, 1], x.imag, error, what=f"{name}.{quantity}.y")
    distance, rate, _ = derivatives(lambda s: np.abs(tracer_of(s)[0] - tracer_of(s)[2]), t)
    assert_close(column(file, "motions", "distance", "gap"), distance, 1e-12)
    assert_close(column(file, "motions", "distance_rate", "gap"), rate, 1e-10)
    assert_close(column(file, "points", "position", "far")[:, :2], np.tile([0.25, 0.0], (len(t), 1)), 0.0)


@pytest.mark.parametrize("is_spatial", [False, True])
def test_reactions_balance_the_coupler(gudgeon, is_spatial):
    """Both reactions on the coupler give it its acceleration, their moments about the tracer its change of angular momentum."""
    _, file, _ = run(gudgeon, four_bar(is_spatial))
    part = list(file["bodies/names"][:]).index(b"coupler")
    place, speed_up = (file[f"bodies/{name}"][:, part] for name in ("position", "acceleration"))
    turning = file["bodies/angular_acceleration"][:, part].reshape(len(place), -1)[:, -1]
    force = {name: column(file, "reactions", "force", name) for name in ("heel_end", "head_end", "felt_end")}
    moment = {name: column(file, "reactions", "moment", name).reshape(len(place), -1)[:, -1] for name in force}
    assert_close(force["heel_end"] + force["head_end"], 2.25 * speed_up, 1e-7)
    arm = place - column(file, "points", "position", "tracer")
    spin = 2.0 * turning + 2.25 * (arm[:, 0] * speed_up[:, 1] - arm[:, 1] * speed_up[:, 0])
    assert_close(moment["heel_end"] + moment["head_end"], spin, 1e-7)
    crank, head = tracer_of(file["time"][:])[1:]
    along = (head - crank) / 0.4
    felt = (force["heel_end"][:, 0] + 1j * force["heel_end"][:, 1]) / along
    assert_close(force["felt_end"][:, 0], felt.real, 1e-8)
    assert_close(force["felt_end"][:, 1], felt.imag, 1e-8)
    assert_close(moment["felt_end"], moment["heel_end"], 1e-8)


# A rod of 2 kg and 1 m that turns at 3 rad/s about its end, driven, in gravity.
ROD = """deck = 1
[scene]
gravity = 0 -9.81 m/s^2
[bodies]
name mass[kg] inertia[kg.m^2] x[m] y[m] angle[deg]
rod  2        {2 kg*(1 m)^2/12} 0.5 0 0
[points]
name body xi[m] eta[m]
o ground 0 0
top rod -0.5 0
end rod 0.5 0
[joint.revolute]
name i j
pin o top
[driver.speed]
name joint speed
motor pin 3rad/s
[request.reaction]
name   joint  on  point  frame
grip   pin    j   -      rod
wall   pin    i   -      -
far    pin    j   end    rod
turn   motor  j   -      rod
[request]
name    value                                    unit
level   {norm}                                   N
work    {request.level*end.velocity.x}           W
bend    {2*pin.moment + abs(motor.moment)}       -
"""


def rod(analysis="analysis.kinematic", output="", extra="", norm="sqrt(pin.force.x^2 + pin.force.y^2)"):
    """The deck of the rod."""
    accurate = "tolerance = 1e-10\n" if analysis == "analysis.dynamic" else ""
    return ROD.replace("norm", norm) + f"{extra}[{analysis}]\nend = 2 s\n{accurate}[output]\nevery = 10 ms\n{output}"


@pytest.mark.parametrize("analysis", ["analysis.kinematic", "analysis.dynamic"])
def test_reaction_in_the_frame_of_a_body(gudgeon, analysis):
    """Along the rod: weight and centripetal force, across it: weight; with the lever of another point; the driver's moment."""
    _, file, _ = run(gudgeon, rod(analysis))
    t = file["time"][:]
    angle = 3.0 * t
    along = -2.0 * 0.5 * 9.0 + 2.0 * 9.81 * np.sin(angle)
    across = 2.0 * 9.81 * np.cos(angle)
    moment = 2.0 * 9.81 * 0.5 * np.cos(angle)
    force = {name: column(file, "reactions", "force", name) for name in ("grip", "wall", "far", "turn")}
    assert_close(force["grip"], np.array([along, across]).T, 1e-8)
    assert_close(force["far"], force["grip"], 1e-12)
    assert_close(force["turn"], 0.0, 1e-12)
    world = np.array([along * np.cos(angle) - across * np.sin(angle), along * np.sin(angle) + across * np.cos(angle)]).T
    assert_close(force["wall"], -world, 1e-8)
    assert_close(column(file, "reactions", "moment", "grip"), 0.0, 1e-8)
    assert_close(column(file, "reactions", "moment", "far"), -1.0 * across, 1e-8)
    assert_close(column(file, "reactions", "moment", "turn"), moment, 1e-8)


def test_expressions_are_channels_like_any(gudgeon):
    """Files, extremes, statistics, a condition that ends the run, accuracy: all know request.NAME; the unit is that of its value."""
    output = "channels = request.* end.velocity\n"
    statistics = "[statistics]\nchannels = request.level\n"
    directory, file, _ = run(gudgeon, rod("analysis.dynamic", output, statistics))
    t = file["time"][:]
    level = np.hypot(9.0 - 2 * 9.81 * np.sin(3 * t), 2 * 9.81 * np.cos(3 * t))
    assert_close(file["requests/level"][:], level, 1e-7)
    assert file["requests/level"].attrs["units"] == "N" and file["requests/work"].attrs["units"] == "W"
    assert_close(file["requests/work"][:], level * -3.0 * np.sin(3 * t), 1e-6)
    assert (directory / "request.dat").read_text().startswith("# time[s] request.level[N] request.work[W] request.bend[N.m]")
    assert_close(np.loadtxt(directory / "request.dat")[4, 1], level[4], 1e-7)
    summary = json.loads((directory / "summary.json").read_text())
    extremes = {row["channel"]: row for row in summary["extremes"]}
    assert_close(extremes["request.level"]["greatest"], 9.0 + 2 * 9.81, 1e-6)  # where sin(3 t) = -1, between two rows
    rms = np.sqrt(np.sum((level[1:] ** 2 + level[:-1] ** 2) / 2 * np.diff(t)) / 2)
    assert_close(summary["statistics"]["request.level.rms"], rms, 1e-6)
    directory, file, _ = run(gudgeon, rod("analysis.dynamic", output, "[guards]\nstop = request.level > 25 N\n"))
    stopped = json.loads((directory / "summary.json").read_text())
    assert "request.level" in stopped["message"]
    end = file["time"][-1]
    assert_close(np.hypot(9.0 - 2 * 9.81 * np.sin(3 * end), 2 * 9.81 * np.cos(3 * end)), 25.0, 1e-6)
    directory, _, _ = run(gudgeon, rod("analysis.dynamic", "channels = request.level\n"), "--accuracy", "1e-5")
    assert json.loads((directory / "summary.json").read_text())["accuracy"]["claim"] == "end"


def test_points_speak_only_when_asked(gudgeon):
    """Without words for channels, and with `*`, there are no points; a named one has its file."""
    for output in ("", "channels = *\n", "channels = *.velocity\n"):
        directory, file, _ = run(gudgeon, rod("analysis.kinematic", output))
        assert "points" not in file and not (directory / "end.dat").exists()
    directory, file, _ = run(gudgeon, rod("analysis.kinematic", "channels = end.position.y\n"))
    assert list(file["points/names"][:]) == [b"end"] and (directory / "end.dat").exists()


WRONG = [
    ("{pin.forze.x}", "did you mean 'pin.force.x'", 1),
    ("{pin.force}", "several components", 1),
    ("{request.work}", "there is no request 'work' before this one", 1),
    ("{pin.force.x + pin.moment}", "cannot", 0),
    ("{pin.moment}", "its SI unit is N.m", 0),
    ("{2*(pin.force.x}", "missing closing parenthesis", 1),
]


@pytest.mark.parametrize("value, words, has_caret", WRONG)
def test_mistakes_in_requests(gudgeon, value, words, has_caret):
    """Each is told with its place."""
    text = rod().replace("{sqrt(pin.force.x^2 + pin.force.y^2)}", value)
    done = call(gudgeon, "check", written(scratch(), text), expect=3)
    if words != "cannot":
        assert words in done.stderr
    assert ".deck:" in done.stderr and "^" in done.stderr


def test_mistakes_in_tables_of_requests(gudgeon):
    """A joint, a point, a body that are not there; names that are taken."""
    for old, new, words in (
        ("grip   pin  ", "grip   pon  ", "unknown joint 'pon'"),
        ("far    pin    j   end", "far    pin    j   and", "unknown point 'and'"),
        ("j   -      rod\nwall", "j   -      rot\nwall", "unknown body 'rot'"),
        ("grip   pin  ", "rod    pin  ", "used twice"),
        ("motor pin 3", "motor pin {3rad/s*rod.angle/1rad} #", "is not allowed here"),
    ):
        assert old in rod(), old
        done = call(gudgeon, "check", written(scratch(), rod().replace(old, new)), expect=3)
        assert words in done.stderr, done.stderr


def test_echo_of_requests(gudgeon):
    """The deck as understood gives the same numbers."""
    directory, file, _ = run(gudgeon, rod("analysis.kinematic"))
    again = scratch()
    call(gudgeon, "run", directory / "deck.echo", "--out", again / "o")
    other = h5py.File(again / "o" / "run.h5")
    for path in ("requests/work", "reactions/moment", "requests/bend"):
        assert np.array_equal(file[path][:], other[path][:])


# A shaft in a journal brake: a ring that turns in a pad above it, pressed up by a force, slowed by dry friction.
BRAKE = """deck = 1
[scene]
gravity = 0 0 m/s^2
[parameters]
lean = {atan(0.2)}
deep = {0.1 mm + 1 m*(500/sqrt(1.04)/1e9)^(2/3)}
[bodies]
name mass[kg] inertia[kg.m^2] x[m] y[m] angle[rad] omega[rad/s]
shaft 2 0.05 {-deep*sin(lean)} {-deep*cos(lean)} 0 40
[points]
name body xi[m] eta[m]
hole ground 0 0
axle shaft 0 0
[material]
name young[GPa] poisson
steel 200 0.3
[contact.hunt_crossley]
name restitution stiffness[N/m^1.5]
law 0.3 1e9
[friction.coulomb]
name coefficient
dry 0.2
[clearance.revolute]
name bearing journal bearing_radius[mm] clearance[mm] length[mm] material law friction
pad hole axle 20 0.1 30 steel law dry
[force.point]
name point fx[N] fy[N]
press axle 0 -500
[request.reaction]
name joint on point frame
hold pad j axle shaft
wall pad i hole -
[analysis.dynamic]
end = 0.2 s
tolerance = 1e-8
start = given
overlap = preload
[output]
every = 0.1 ms
channels = pad.normal_force pad.p_v pad.sliding_speed pad.contact_angle pad.contact_power pad.state pad.force shaft.* hold.* wall.* energy.*
"""


def test_p_v_of_a_journal_brake(gudgeon):
    """Pressure W/(2 R L) times the speed of the shaft's surface, friction and damping as the ledger has them, where it presses."""
    _, file, _ = run(gudgeon, BRAKE)
    rows = (file["row_kind"][:] == 0) & (file["time"][:] > 0)
    read = lambda path: file[path][:][rows]
    contact = lambda name: read(f"clearances/contacts/{name}")[:, 0]
    t, omega = read("time"), read("bodies/angular_velocity")[:, 0]
    radius, length = 0.0199, 0.03
    place, speed = read("bodies/position")[:, 0], read("bodies/velocity")[:, 0]
    out = place / np.linalg.norm(place, axis=1)[:, None]
    arm = radius - (np.linalg.norm(place, axis=1) - 0.0001) / 2  # the surfaces meet halfway through the penetration
    sliding = np.abs(speed[:, 1] * out[:, 0] - speed[:, 0] * out[:, 1] + arm * omega)
    assert contact("state").all()
    assert_close(contact("normal_force").mean(), 500 / np.sqrt(1 + 0.2**2), relative=0.01)
    assert_close(contact("sliding_speed"), sliding, 1e-6)
    assert_close(contact("p_v"), contact("normal_force") / (2 * radius * length) * sliding, relative=1e-6)
    assert_close(contact("contact_angle"), np.arctan2(place[:, 1], place[:, 0]), 1e-12)
    force, angle = read("clearances/force")[:, 0], read("bodies/angle")[:, 0]
    turned = [force[:, 0] * np.cos(angle) + force[:, 1] * np.sin(angle), force[:, 1] * np.cos(angle) - force[:, 0] * np.sin(angle)]
    assert_close(read("reactions/force")[:, 0], np.array(turned).T, 1e-9)
    assert_close(read("reactions/force")[:, 1], -force, 1e-9)
    assert_close(read("reactions/moment")[:, 0], 0.05 * read("bodies/angular_acceleration")[:, 0], 1e-9)
    balance = read("reactions/moment").sum(axis=1) - (place[:, 1] * force[:, 0] - place[:, 0] * force[:, 1])
    assert_close(balance, 0.0, 1e-9)
    lost = read("energy/dissipated_contact") + read("energy/dissipated_friction")
    power = contact("contact_power")
    gathered = np.sum((power[1:] + power[:-1]) / 2 * np.diff(t))
    assert_close(gathered, lost[-1] - lost[0], relative=1e-4)
    assert_close((omega[-1] - omega[0]) * 0.05, -0.2 * np.sum((arm * contact("normal_force"))[1:] * np.diff(t)), relative=1e-3)


def test_numbers_have_the_unit_that_is_asked_for(gudgeon, tmp_path):
    """An energy in J is no moment, and what is asked for in a unit that is not of the SI has that of the SI."""
    text = (ROOT / "inputs" / "bouncing_ball.deck").read_text(encoding="utf-8") + """
[request]
name   value                              unit
gain   {energy.kinetic}                   J
other  {energy.kinetic}                   -
square {ball.velocity.y*ball.velocity.y}  m^2/s^2
high   {ball.position.y}                  mm
"""
    call(gudgeon, "run", written(tmp_path, changed(text, "output", figures=None, channels="request.*")), "--out", tmp_path / "run",
         "--quiet")
    head = (tmp_path / "run" / "request.dat").read_text(encoding="utf-8").split("\n", 1)[0]
    assert head.startswith("# time[s] request.gain[J] request.other[N.m] request.square[m^2/s^2] request.high[m]")
