"""A report finds the multipliers that are read and what these hang on: each is the same bit for bit whatever else is read."""

import re

import h5py
import numpy as np
import pytest
from support import ROOT, call, plain, scratch, written


def channels_of(gudgeon, directory, text, words):
    """Time histories of joints and drivers, by name, of a short run with some channels."""
    text = re.sub(r"(?m)^(channels|figures) .*\n", "", text).replace("[output]\n", f"[output]\nchannels = {words}\n")
    out = scratch()
    call(gudgeon, "run", written(directory, text, "short.deck"), "--out", out / "run", "--quiet", "--write", "channels")
    found = {}
    with h5py.File(out / "run" / "run.h5", "r") as file:
        for room in {"joints", "drivers"} & set(file):
            names = [str(name).strip() for name in plain(file[f"{room}/names"][()])]
            for quantity, values in file[room].items():
                if quantity == "names" or values.dtype.kind != "f" or values.ndim < 2:
                    continue
                for place, name in enumerate(names):
                    if not np.isnan(values[:, place]).all():
                        found[f"{name}.{quantity}"] = values[:, place]
    return found


@pytest.mark.parametrize("deck, most", [("slider_crank_dry", 15), ("slider_crank_two_joints", 11), ("four_bar_spatial", 12)])
def test_alone_as_among_all(gudgeon, deck, most):
    """Known and guided bodies, in the plane and in space."""
    directory = scratch()
    text = (ROOT / "inputs" / f"{deck}.deck").read_text()
    text = re.sub(r"(?m)^every .*", "every = 100 us", re.sub(r"(?m)^end .*", "end = 1 ms", text))
    together = channels_of(gudgeon, directory, text, "*")
    assert len(together) >= most
    for name in sorted(together)[:most]:
        alone = channels_of(gudgeon, directory, text, name)
        assert alone[name].tobytes() == together[name].tobytes(), name
