"""Runs that are killed: whatever is in run.h5 can be read, and every row there is one of the run."""

import os
import signal
import subprocess
import time

import h5py
import numpy as np
import pytest
from support import WrittenRun, is_history, plain, plain_deck


def histories(path):
    """All time histories of a file and its events by path, its status and the message; every dataset and attribute is read."""
    found = {}

    def visit(name, node):
        dict(node.attrs)
        if isinstance(node, h5py.Dataset):
            values = node[()]
            if is_history(node) or name in ("time", "events"):
                found[name] = values

    with h5py.File(path, "r") as file:
        file.visititems(visit)
        attributes = {name: plain(value) for name, value in file.attrs.items()}
        return found, attributes["status"], attributes["status_message"]


def test_a_killed_run_can_be_read(gudgeon, tmp_path):
    """While a run is going on nobody else may write there; killed, it leaves whole rows in order."""
    (tmp_path / "long.deck").write_text(plain_deck((("analysis.dynamic", "end", "100 s"),)), encoding="utf-8")
    command = [gudgeon, "run", tmp_path / "long.deck", "--out", tmp_path / "run", "--quiet"]
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    path = tmp_path / "run" / "run.h5"
    try:
        for _ in range(600):
            time.sleep(0.1)
            assert process.poll() is None, "the run ended too early"
            if path.exists() and path.stat().st_size > 500_000:
                break
        refused = subprocess.run(command, capture_output=True, text=True, timeout=60)
        assert refused.returncode == 9
        assert "is writing to" in refused.stderr
    finally:
        os.kill(process.pid, signal.SIGKILL)
        process.wait()
    found, status, _ = histories(path)
    assert status == "running"
    times = found["time"]
    assert len(times) >= 128
    assert np.all(np.diff(times) >= 0)
    assert np.all(np.diff(times[found["row_kind"][: len(times)] == 0]) > 0)
    assert all(len(values) >= len(times) for name, values in found.items() if name != "events")
    assert not (tmp_path / "run" / "summary.json").exists()


@pytest.mark.slow
@pytest.mark.parametrize("condition", ["", "crank.angle > 15 rad"])
def test_a_run_killed_at_any_write(gudgeon, tmp_path, condition):
    """A SIGKILL before any of the writes to run.h5, from the first flush to the last one of the end, leaves a file that can be read
    and has the rows of the same run without a kill: as many as /time says, or more of the last block. A run that a condition ends has a
    message besides, written where an empty one was."""
    deck = tmp_path / "scene.deck"
    text = plain_deck((("analysis.dynamic", "end", "30 ms"), ("output", "every", "4 us")))
    if condition:
        text += f"\n[guards]\nstop = {condition}\n"
    deck.write_text(text + "\n[statistics]\nafter = 5 ms\nchannels = slider.velocity\n")

    run = WrittenRun(gudgeon, deck, tmp_path, "run.h5")
    assert "in two pages" not in run.told
    whole, status, message = histories(run.whole)
    assert status == "complete" and bool(message) == bool(condition)
    assert len(whole["time"]) > 12 * 512 and len(whole["events"]) > 40
    lengths = []
    # the last writes one by one, those before in strides that are no multiple of what a block takes
    for at, left in run.left_by_kills([*range(1, run.writes - 60, 17), *range(run.writes - 60, run.writes + 1)]):
        try:
            found, status, text = histories(left)
        except OSError as failure:  # before the first flush there is no file yet
            assert "signature not found" in str(failure) and not lengths, (at, failure)
            continue
        n = len(found["time"])
        lengths.append(n)
        events = found.pop("events")
        assert np.all(np.diff(events["time"]) >= 0) and np.all(np.isin(events["time"], whole["events"]["time"])), at
        assert status == "running" or (status == "complete" and n == len(whole["time"])), at
        assert text in ("", message) and (text == message or status == "running"), at
        for name, values in found.items():
            assert len(values) >= n, (at, name)
            np.testing.assert_array_equal(values, whole[name][: len(values)], err_msg=f"{name}, killed at write {at}")
    assert lengths == sorted(lengths) and lengths[0] == 0 and lengths[-1] == len(whole["time"])
    assert len(set(lengths)) > 10
