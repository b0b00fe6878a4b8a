"""gudgeon compare where numbers are missing, do not go on smoothly, or do not change: the verdict, the counts, the peaks, the pictures."""

import functools
import json
import re

from support import call, scratch, written
from test_compare import PENDULUM

# The rod's angle falls from 0 to -pi and comes back: `half` is a number while it is above -1 rad, `none` never.
REQUESTS = """
[request]
name   value                        unit
half   {{3*sqrt({half} + rod.angle)}}   1
none   {{3*sqrt({none} + rod.angle)}}   1
fixed  {{3*(1 + {noise}*sin(40*rod.angle))}}   1
"""
ASKED = "channels = rod.position.x request.half request.none request.fixed"


@functools.cache
def pendulums(program):
    """Runs whose requests have numbers throughout, or in part, or nowhere."""
    folder = scratch()
    text = PENDULUM.replace("channels = rod.position rod.velocity rod.angle", ASKED)
    for name, half, none, noise in (("all", 100, 100, 0), ("part", 1, -100, 1e-15), ("near", 1, 100, 1e-5)):
        deck = written(folder, text + REQUESTS.format(half=half, none=none, noise=noise), name + ".deck")
        call(program, "run", deck, "--quiet", "--out", name, cwd=folder)
    return folder


def compared(program, folder, a, b, *options, expect):
    """What compare found, channel by channel, all that it found, and what it said; summary.json says the same."""
    out = scratch()
    said = call(program, "compare", a, b, "--out", out, *options, cwd=folder, expect=expect).stdout
    found = json.loads((out / "summary.json").read_text())
    return {channel["channel"]: channel for channel in found["channels"]}, found, said, out


def test_pictures_line_up(gudgeon):
    """Both panels have the same margins; round-off of a constant is a line, and ticks that differ late have their digits."""
    folder = pendulums(gudgeon)
    scripts = {}
    for b in ("part", "near"):
        _, _, _, out = compared(gudgeon, folder, "all", b, expect=1)
        scripts[b] = (out / "figures" / "request.fixed.gp").read_text(encoding="utf-8")
    for script in scripts.values():
        before = script[: script.index("set multiplot")]
        assert re.search(r"set lmargin at screen [\d.]+; set rmargin at screen [\d.]+", before) and script.count("margin") == 2
    first = scripts["part"].split("\nplot ")[0]
    assert "set yrange [2.7:3.3]" in first
    first = scripts["near"].split("\nplot ")[0]
    assert re.search(r"set ytics [\dEe.-]+; set format y '%\.5f'", first) and "yrange [2.7" not in first
