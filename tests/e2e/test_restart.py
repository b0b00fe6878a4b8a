"""Runs that are stopped and go on: the same bits, and refusals that name the difference."""

import json
import resource
import shutil
import signal
import subprocess
import time

import h5py
import pytest
from support import ROOT, Run, answer_signals, call, changed, made, plain_deck, written
from test_groups import balls


def test_restarts_change_nothing(gudgeon, tmp_path):
    """Contacts of the dry slider-crank, by a method without and by methods with a history."""
    for method in ("verner", "bdf", "ida"):
        deck = written(tmp_path, plain_deck((("analysis.dynamic", "checkpoint", "1 ms"), ("analysis.dynamic", "method", method))))
        done = call(gudgeon, "run", deck, "--out", tmp_path / method, "--verify-restart")
        assert "equal bit for bit after 3 restarts" in done.stdout
        assert not (tmp_path / f"{method}.restart").exists()
        assert not (tmp_path / method / "checkpoint.h5").exists()


def test_large_scenes_and_groups(gudgeon, tmp_path):
    """A solver that goes on with the pivots of before, by methods with and without a history; groups with steps of their own; the
    file of the motion."""
    chain = made("pendulum", 60, "--end", "0.2", "--every", "0.02", "--solver", "sparse")
    falling = changed(balls(6)[0], "analysis.dynamic", checkpoint="20 ms")
    side_by_side = changed((ROOT / "inputs" / "hard" / "side_by_side.deck").read_text(), "analysis.dynamic",
                           end="210 ms", checkpoint="25 ms")  # functions of time with corners
    decks = {"one_step": chain, "corners": side_by_side, "bdf": changed(chain, "analysis.dynamic", method="bdf", checkpoint="0.05 s"), "groups": falling,
             "motion": plain_deck((("output", "motion", "vtkhdf"),))}
    for name, text in decks.items():
        deck = written(tmp_path, text, f"{name}.deck")
        done = call(gudgeon, "run", deck, "--out", tmp_path / name, "--verify-restart")
        assert "equal bit for bit after 3 restarts" in done.stdout, name


def test_ways_without_rows(gudgeon_debug, tmp_path):
    """What holds constraints is saved where there are none: a free body has no dependent coordinates to remember."""
    text = changed((ROOT / "inputs" / "hard" / "tumbling_body.deck").read_text(), "output", figures=None)
    for way in ("partitioning", "baumgarte_adaptive", "projection"):
        deck = written(tmp_path, changed(text, "analysis.dynamic", stabilise=way, end="0.5 s", checkpoint="0.1 s"))
        done = call(gudgeon_debug, "run", deck, "--out", tmp_path / way, "--verify-restart")
        assert "equal bit for bit after 3 restarts" in done.stdout, way


LONG = (("analysis.dynamic", "end", "100 s"), ("analysis.dynamic", "checkpoint", "1 ms"))


def begun(gudgeon, deck, out, *options):
    """A run in the background that has saved something."""
    process = subprocess.Popen([gudgeon, "run", deck, "--out", out, "--quiet", *options], stderr=subprocess.PIPE, text=True, preexec_fn=answer_signals)
    for _ in range(1000):
        if (out / "checkpoint.h5").exists():
            return process
        assert process.poll() is None, process.communicate()[1]
        time.sleep(0.01)
    process.kill()
    raise AssertionError("no checkpoint")


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT, signal.SIGHUP, signal.SIGUSR1])
def test_a_signal_saves_the_run(gudgeon, tmp_path, number):
    """Exit code 7, status stopped, and a run of another deck does not go on from there."""
    deck, out = written(tmp_path, plain_deck(LONG)), tmp_path / "out"
    process = begun(gudgeon, deck, out)
    process.send_signal(number)
    said = process.communicate(timeout=60)[1]
    assert process.returncode == 7 and "--resume continues from there" in said
    with h5py.File(out / "run.h5") as file:
        assert file.attrs["status"].decode() == "stopped"
    assert Run(out).summary["status"] == "stopped"
    if number != signal.SIGTERM:
        return
    done = call(gudgeon, "run", deck, "--out", out, "--resume", "--set", "friction=0.1", expect=2)
    assert "belongs to another run: deck" in done.stderr
    call(gudgeon, "run", deck, "--out", out, "--resume", "--walltime", "1s", "--quiet", expect=7)


def test_a_killed_run_goes_on(gudgeon, tmp_path):
    """SIGKILL, and --resume: the run that nobody disturbed, in every byte of text files and figures, in every number of run.h5."""
    figures = "gudgeon.orbit slider.acceleration.x portrait(slider.velocity.x,motor.moment)"
    deck = written(tmp_path, plain_deck((("analysis.dynamic", "checkpoint", "1 ms"), ("output", "every", "5 us"), ("output", "figures", figures))))
    call(gudgeon, "run", deck, "--out", tmp_path / "whole", "--quiet")
    process = begun(gudgeon, deck, tmp_path / "out")
    process.kill()
    process.communicate()
    assert process.returncode == -signal.SIGKILL
    call(gudgeon, "run", deck, "--out", tmp_path / "out", "--resume", "--quiet")
    whole, other = Run(tmp_path / "whole"), Run(tmp_path / "out")
    assert whole.rows("time").tobytes() == other.rows("time").tobytes()
    assert whole.rows("bodies/velocity").tobytes() == other.rows("bodies/velocity").tobytes()
    assert whole.contacts.tobytes() == other.contacts.tobytes()
    pictures = list((tmp_path / "whole" / "figures").iterdir())
    assert {path.suffix for path in pictures} == {".dat", ".gp", ".png"}
    for path in [*(tmp_path / "whole").glob("*.dat"), *pictures]:
        assert path.read_bytes() == (tmp_path / "out" / path.relative_to(tmp_path / "whole")).read_bytes(), path.name
    assert not (tmp_path / "out" / "checkpoint.h5").exists()


def test_a_directory_that_vanishes(gudgeon, tmp_path):
    """The next checkpoint cannot be written: exit code 9, which names it."""
    deck = written(tmp_path, plain_deck(LONG))
    process = begun(gudgeon, deck, tmp_path / "out")
    shutil.rmtree(tmp_path / "out", ignore_errors=True)
    said = process.communicate(timeout=60)[1]
    assert process.returncode == 9 and str(tmp_path / "out") in said, said


def test_a_run_that_found_no_room_begins_anew(gudgeon, tmp_path):
    """Without a checkpoint --resume begins; a run that failed has not come to its end."""
    deck = written(tmp_path, plain_deck((("output", "every", "5 us"),)))
    out, limit = tmp_path / "out", 768 << 10
    done = subprocess.run([gudgeon, "run", deck, "--out", out, "--quiet"], capture_output=True, text=True, timeout=60,
                          preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit)))
    assert done.returncode == 9 and not (out / "checkpoint.h5").exists()
    assert "starts at t = 0" in call(gudgeon, "run", deck, "--out", out, "--resume", "--quiet").stderr
    assert json.loads((out / "summary.json").read_text())["status"] == "complete"
    assert "nothing to resume" in call(gudgeon, "run", deck, "--out", out, "--resume", "--quiet").stderr


def test_checkpoints_that_find_no_room(gudgeon, tmp_path):
    """Files that may not grow: exit code 9, rows that can be read, the last checkpoint is whole and goes on elsewhere."""
    deck = written(tmp_path, plain_deck((("analysis.dynamic", "checkpoint", "1 ms"), ("output", "every", "5 us"))))
    out, limit = tmp_path / "out", 768 << 10
    done = subprocess.run([gudgeon, "run", deck, "--out", out, "--quiet"], capture_output=True, text=True, timeout=60,
                          preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit)))
    assert done.returncode == 9 and "error: cannot" in done.stderr, done
    assert len(Run(out).rows("time")) > 100
    call(gudgeon, "run", deck, "--out", out, "--resume", "--quiet")
    call(gudgeon, "run", deck, "--out", tmp_path / "whole", "--quiet")
    assert Run(out).rows("bodies/velocity").tobytes() == Run(tmp_path / "whole").rows("bodies/velocity").tobytes()


def test_what_cannot_be_saved_is_refused(gudgeon, tmp_path):
    """A method with a history and no checkpoints; an analysis that is no motion; too much output."""
    deck = written(tmp_path, plain_deck((("analysis.dynamic", "method", "adams"),)))
    assert "checkpoint = " in call(gudgeon, "run", deck, "--out", tmp_path / "a", "--walltime", "1h", expect=2).stderr
    kinematic = ROOT / "inputs" / "four_bar_kinematic.deck"
    refused = call(gudgeon, "run", kinematic, "--resume", "--out", tmp_path / "b", expect=2).stderr
    assert "option --resume needs [analysis.dynamic]; the analysis of this deck is kinematic" in refused
    small = written(tmp_path, changed(plain_deck(), "output", size_limit="1e-5"))
    assert "'size_limit' in [output] allows" in call(gudgeon, "run", small, "--out", tmp_path / "c", expect=3).stderr
