"""What explain says is dropped: it follows every reference of every column, and the joints without an ideal twin."""

import re

import pytest
from support import ROOT, Run, call, changed, scratch, written

BALL = """deck = 1
[bodies]
name   mass[kg]  inertia[kg.m^2]  x[m]  y[m]
ball   1         0.01             0     0.2
block  1         0.01             2     0.0254
[points]
name   body    xi[m]  eta[m]
floor  ground  0      0
table  ground  2      0
pole   ball    0      0
heart  block   0      0
[material]
name    young[GPa]  poisson
steel   207         0.3
rubber  0.1         0.49
lead    16          0.44
[clearance.plane]
name   plane  ball  axis  radius[mm]  material  ball_material  law
bump   floor  pole  y     50          steel     rubber         corner
[clearance.translational]
name   guide  slider  axis  length[mm]  height[mm]  width[mm]  gap[mm]  corner_radius[mm]  material  law     face_law  faces
slot   table  heart   x     50          50          20         0.5      1                  steel     corner  face      foundation
[contact.hertz]
name
corner
spare
[contact.plane_face]
name  stiffness[N/m]  restitution
face  1e9             0.9
[analysis.dynamic]
end = 10 ms
"""


@pytest.fixture
def deck():
    """A ball of another material than its plane, and a block with a law for its faces."""
    return written(scratch(), BALL)


@pytest.mark.parametrize("options", [(), ("--ideal",)])
@pytest.mark.parametrize("build", ["gudgeon", "gudgeon_debug"])
def test_every_reference_counts(build, options, deck, request):
    """A material that only a ball names and a law of faces are used; what nothing names is not."""
    text = call(request.getfixturevalue(build), "explain", deck, *options).stdout
    assert set(re.findall(r"'(\w+)': no joint refers to it", text)) == {"spare", "lead"}


def test_nothing_is_dropped(gudgeon):
    """Where the motion needs all that the deck gives, explain says so."""
    text = call(gudgeon, "explain", ROOT / "inputs" / "ferris_wheel.deck").stdout
    assert "\nnot used\n  nothing\n" in text


@pytest.mark.parametrize("build", ["gudgeon", "gudgeon_debug"])
def test_a_plane_has_no_ideal_twin(build, request):
    """With --ideal a ball keeps its plane: it bounces as without, and no verb falls over."""
    program = request.getfixturevalue(build)
    text = changed((ROOT / "inputs" / "bouncing_ball.deck").read_text(), "output", figures=None)
    names = []
    for options in ((), ("--ideal",)):
        directory = scratch()
        deck = written(directory, text)
        call(program, "check", deck, *options)
        assert "joints with clearance" in call(program, "explain", deck, *options).stdout
        call(program, "run", deck, "--out", directory / "out", "--quiet", *options)
        names.append(Run(directory / "out").contacts["time"])
    assert len(names[0]) > 0 and (names[0] == names[1]).all()
