"""Round-off is no result: what a pendulum at rest or a guide without a load makes of rounding is zero in tables and comparisons."""

import csv
import math
import re

from support import Run, call, changed, scratch, written

PENDULUM = """deck = 1
[scene]
title = "pendulum at rest"
space = planar
gravity = 0 -9.81 m/s^2
[bodies]
name mass[kg] inertia[kg.m^2] x[m]  y[m]  angle[deg]
bob  2.3      0.017           0     -0.7  33
[points]
name body xi[m] eta[m]
o ground 0 0
p bob {xi} {eta}
[joint.revolute]
name i j
pivot o p
[analysis.dynamic]
end = 2 s
[output]
every = 10 ms
channels = *
"""

AT_REST = PENDULUM.replace("{xi}", repr(0.7 * math.sin(math.radians(33)))).replace("{eta}", repr(0.7 * math.cos(math.radians(33))))


def run_of(gudgeon, text, name="out"):
    directory = scratch()
    call(gudgeon, "run", written(directory, text), "--quiet", "--write", "channels", "--out", directory / name)
    return Run(directory / name)


def test_pendulum_at_rest(gudgeon):
    run = run_of(gudgeon, AT_REST)
    text = (run.directory / "summary.txt").read_text()
    assert "bob.position.y" in text and "pivot.force.y" in text
    for name in ("bob.velocity.x", "bob.velocity.y", "bob.angular_velocity", "pivot.force.x", "bob.acceleration.x"):
        assert name not in text, name
    assert not re.search(r"\de-(1[3-9]|[2-9]\d)\b", text.split("extremes")[1].split("output")[0])


def test_compare_does_not_see_it(gudgeon):
    """Runs of both halves of a symmetric motion: what differs by rounding does not differ, unless every bit is asked for."""
    first = run_of(gudgeon, AT_REST)
    second = run_of(gudgeon, changed(AT_REST, "analysis.dynamic", tolerance="1e-9", method="dop853"))
    where = scratch()
    call(gudgeon, "compare", first.directory, second.directory, "--quiet", "--out", where / "compared")
    with (where / "compared/compare.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert rows and all(row["differs"] == "0" for row in rows)


def test_numbers_are_kept_and_thresholds_told(gudgeon):
    run = run_of(gudgeon, AT_REST)
    channels = {e["channel"]: e for e in run.summary["extremes"]}
    names = list(run.read("extremes/channels/name"))
    kept = run.read("extremes/channels/greatest")[names.index("pivot.force.x")]
    assert channels["pivot.force.x"]["greatest"] == kept
    told = call(gudgeon, "explain", written(scratch(), AT_REST)).stdout
    assert "channels shown as zero" in told and "1e-12 of the maximum force" in told
