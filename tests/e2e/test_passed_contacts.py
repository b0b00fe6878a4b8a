"""A contact that begins and ends within a step is passed over where onsets are looked for at the ends of steps only: the run says so.

Two balls fly past each other: the gap is r at least, 2 r - r of overlap, at t = 75 ms; they overlap for 50 ms around it.
"""

import json

import pytest
from support import ROOT, call, changed, written

HIT = "joint 'click', law 'lankarani_nikravesh': "


def shot(program, directory, *options, expect=0, **analysis):
    """Run the billiard deck."""
    directory.mkdir(exist_ok=True)
    text = changed((ROOT / "inputs/billiards.deck").read_text(), "analysis.dynamic", **analysis)
    done = call(program, "run", written(directory, text), "--out", directory / "out", "--write", "channels", *options, expect=expect)
    summary = json.loads((directory / "out/summary.json").read_text())
    return done.stdout, (directory / "out/summary.txt").read_text(), summary


@pytest.mark.parametrize(
    "onset, step", [("interpolate", 50), ("reject", 50), ("uncontrolled", 50), ("interpolate", 40), ("uncontrolled", 40)]
)
def test_passed_over(gudgeon, tmp_path, onset, step):
    """Steps from 50 to 100 ms, apart at both ends, or from 40 to 80 ms, then overlapping on the way out: nothing begins, and the
    terminal and both summaries say so."""
    said, text, summary = shot(gudgeon, tmp_path, method="rk4", step=f"{step} ms", contact_onset=onset)
    assert summary["contacts"] == 0
    (warning,) = [one for one in summary["warnings"] if " missed, with onset and separation" in one]
    assert warning == (
        HIT + f"1 contact was missed, with onset and separation within one step (contact_onset = {onset}): maximum penetration 28.6 mm at "
        "t = 0.075 s, the first at 0.075 s; use shorter steps (step, maximum_step) or contact_onset = located"
    )
    assert "warning: " + warning in said
    assert warning in text


def test_none_passed_over(gudgeon, tmp_path):
    """Located onsets, or steps that see the contact: nothing is said, though it has ended by the end of a step and parts there."""
    for onset in ("located", "interpolate", "reject"):
        analysis = {"contact_onset": onset} | ({} if onset == "located" else {"step": "20 us"})
        summary = shot(gudgeon, tmp_path / onset, **analysis)[2]
        assert summary["contacts"] == 1
        assert not any(" missed, with onset and separation" in one for one in summary["warnings"])


def test_counted_over_a_restart(gudgeon, tmp_path):
    """What was passed over before a checkpoint is told at the end of the run that goes on from it."""
    analysis = {"method": "rk4", "step": "50 ms", "contact_onset": "uncontrolled"}
    whole = shot(gudgeon, tmp_path / "whole", **analysis)[2]
    again = shot(gudgeon, tmp_path / "again", "--verify-restart", **analysis)[2]
    assert [one for one in whole["warnings"] if " missed, with onset and separation" in one] == [one for one in again["warnings"] if " missed, with onset and separation" in one]
    assert any(" missed, with onset and separation" in one for one in again["warnings"])
