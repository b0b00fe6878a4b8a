"""The data of an animation page, read as the page's own script reads them."""

import base64
import json
import re

import numpy as np


def numbers(text, kind="<f4"):
    """An array in base 64."""
    return np.frombuffer(base64.b64decode(text), kind)


def object_of(path):
    """The object `D` of a page as it is written."""
    literal = re.search(r'const D=(\{.*?\nnote:"[^"]*"\});', path.read_text(encoding="utf-8"), re.DOTALL).group(1)
    literal = re.sub(r",(\s*[\]}])", r"\1", re.sub(r"([{,]\s*)(\w+):", r'\1"\2":', literal))
    return json.loads(literal)


def page_data(path):
    """Everything in `D`: lists and texts as they are, arrays of positions with an axis for frames, bodies or joints, components."""
    data = object_of(path)
    data["t"] = numbers(data["t"], "<f8")
    n = len(data["t"])
    for key, width in (("r", 3), ("q", 4), ("g", 3)):
        data[key] = numbers(data[key]).reshape(n, -1, width)
    data["track"]["t"] = numbers(data["track"]["t"], "<f8")
    for key in "fe":
        data["track"][key] = [numbers(values).reshape(-1, 3) for values in data["track"][key]]
    for plot in data["plots"]:
        for curve in plot["curves"]:
            curve["x"], curve["y"] = numbers(curve["x"], "<f8"), numbers(curve["y"])
    for part in data["parts"]:
        part["s"] = numbers(part["s"]).reshape(-1, 3)
        if "t" in part:
            part["t"] = numbers(part["t"], "<i4").reshape(-1, 3)
    return data


def rotation_of(q):
    """Rotation matrices of quaternions x y z w."""
    x, y, z, w = np.moveaxis(np.asarray(q, float), -1, 0)
    rows = [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]
    return np.moveaxis(np.array(rows), (0, 1), (-2, -1))
