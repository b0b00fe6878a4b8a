"""Runs that are stopped and go on: the same bits, and refusals that name the difference."""

import signal
import subprocess
import time

import h5py
from support import ROOT, call, changed, plain_deck, written


def test_restarts_change_nothing(gudgeon, tmp_path):
    """Contacts of the dry slider-crank, by a method without and by methods with a history."""
    for method in ("verner", "bdf", "ida"):
        deck = written(tmp_path, plain_deck((("analysis.dynamic", "checkpoint", "1 ms"), ("analysis.dynamic", "method", method))))
        done = call(gudgeon, "run", deck, "--out", tmp_path / method, "--verify-restart")
        assert "equal bit for bit after 3 restarts" in done.stdout
        assert not (tmp_path / f"{method}.restart").exists()
        assert not (tmp_path / method / "checkpoint.h5").exists()


def test_a_signal_saves_the_run(gudgeon, tmp_path):
    """TERM: exit code 7, status stopped, and a run of another deck does not go on from there."""
    deck = written(tmp_path, plain_deck((("analysis.dynamic", "end", "100 s"),)))
    out = tmp_path / "out"
    process = subprocess.Popen([gudgeon, "run", deck, "--out", out, "--quiet"], stderr=subprocess.PIPE, text=True)
    time.sleep(0.7)
    process.send_signal(signal.SIGTERM)
    said = process.communicate(timeout=60)[1]
    assert process.returncode == 7 and "--resume goes on from there" in said
    with h5py.File(out / "run.h5") as file:
        assert file.attrs["status"].decode() == "stopped"
    done = call(gudgeon, "run", deck, "--out", out, "--resume", "--set", "friction=0.1", expect=2)
    assert "belongs to another run: deck" in done.stderr
    call(gudgeon, "run", deck, "--out", out, "--resume", "--walltime", "1s", "--quiet", expect=7)


def test_what_cannot_be_saved_is_refused(gudgeon, tmp_path):
    """A method with a history and no checkpoints; an analysis that is no motion; too much output."""
    deck = written(tmp_path, plain_deck((("analysis.dynamic", "method", "adams"),)))
    assert "checkpoint = " in call(gudgeon, "run", deck, "--out", tmp_path / "a", "--walltime", "1h", expect=2).stderr
    kinematic = ROOT / "inputs" / "four_bar_kinematic.deck"
    assert "--resume is for motions" in call(gudgeon, "run", kinematic, "--resume", "--out", tmp_path / "b", expect=2).stderr
    small = written(tmp_path, changed(plain_deck(), "output", size_limit="1e-5"))
    assert "'size_limit' in [output] allows" in call(gudgeon, "run", small, "--out", tmp_path / "c", expect=3).stderr
