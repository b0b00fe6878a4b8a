"""Fixed steps that are too long: the error names the step, in every build, and other causes keep their names."""

import pytest
from support import ROOT, call, changed, scratch, written


def failed(program, text, step):
    """What rk4 with such a step says in the end."""
    text = changed(text, "analysis.dynamic", method="rk4", step=step, tolerance=None)
    directory = scratch()
    return call(program, "run", written(directory, text), "--out", directory / "out", "--quiet", "--write", "numbers", expect=5).stderr


@pytest.mark.parametrize("name, step", [("slider_crank_dry", "10 ms"), ("slider_crank_translational", "1 ms"), ("pinball", "1 ms"),
                                        ("double_pendulum", "10 ms"), ("slider_crank_6_6_bushing", "10 ms"),
                                        ("slider_crank_lubricated", "1 ms"), ("slider_crank_lubricated", "10 ms"),
                                        ("journal_bearing", "10 ms")])
def test_step_is_named(gudgeon, gudgeon_debug, name, step):
    """Torn joints, impossible penetrations, speeds and equations without a solution all come of it."""
    value = {"1 ms": "0.001", "10 ms": "0.01"}[step]
    for program in (gudgeon, gudgeon_debug):
        said = failed(program, (ROOT / f"inputs/{name}.deck").read_text(), step)
        said = said[said.index("error:"):]
        assert said.startswith(f"error: the step of {value} s is too long for the motion"), said
        assert "use a shorter step" in said


def test_other_causes_are_not_blamed_on_the_step(gudgeon):
    """A load that does not exist from some time on is none of the step, which is short enough."""
    text = """deck = 1
[scene]
title = "A load that ends"
gravity = 0 0 m/s^2
[bodies]
name mass[kg] inertia[kg.m^2] x[m] y[m]
ball 1 1 0 0
[points]
name body xi[m] eta[m]
heart ball 0 0
[force.point]
name point fx fy
pull heart {sqrt(0.5 - t/(1 s))*(1 N)} {0 N}
[analysis.dynamic]
end = 1 s
"""
    said = failed(gudgeon, text, "10 ms")
    assert "too long" not in said and "the load of force element 'pull' is not finite" in said, said
