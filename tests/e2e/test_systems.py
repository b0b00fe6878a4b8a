"""What keeps the program building on other systems: scripts that read the sources, and those that try a bare Debian."""

import os
import shutil
import subprocess

import pytest
from support import ROOT
from support import call as call_gudgeon
from support import changed, written

HEADER = '"time [s]" "kind" "item"\n'


def call(*command):
    return subprocess.run([str(word) for word in command], capture_output=True, text=True, timeout=60, check=False)


def events(path, onsets):
    path.write_text(HEADER + "".join(f" {onset:.16E} contact pin - free free\n" for onset in onsets), encoding="utf-8")
    return path


def test_onsets_are_compared(root, tmp_path):
    onsets = [0.001 * k for k in range(1, 13)]
    one = events(tmp_path / "one.dat", onsets)
    near = events(tmp_path / "near.dat", [onset + 9e-10 for onset in onsets])
    far = events(tmp_path / "far.dat", onsets[:9] + [onsets[9] + 1.1e-9] + onsets[10:])
    late = events(tmp_path / "late.dat", onsets[:10] + [1.0])
    few = events(tmp_path / "few.dat", onsets[:9])
    none = events(tmp_path / "none.dat", [])
    compare = root / "scripts/compare_onsets"
    for path, expect in ((one, 0), (near, 0), (far, 1), (late, 0), (few, 1), (none, 1)):
        done = call(compare, one, path)
        assert done.returncode == expect, done.stdout
    assert call(compare, none, none).returncode == 1


@pytest.mark.parametrize("path,line,message", [
    ("foundation/core/errors.f90", "use mechanism, only: mechanism_t", "foundation/core must not use mechanics/system (module mechanism)"),
    ("mechanics/bodies/motion.f90", "use joint_set, only: joint_set_t", "mechanics/bodies must not use mechanics/joints (module joint_set)"),
    ("results/figures/figures.f90", "use dynamic, only: run_dynamic", "results/figures must not use analysis/dynamic (module dynamic)"),
    ("mechanics/bodies/motion.f90", "use hdf5", "mechanics/bodies must not use the library module hdf5"),
    ("mechanics/bodies/motion.f90", 'include "../clearance/push.inc"', "an include names a file beside this one or in a folder that mechanics/bodies may use")])
def test_upward_uses_are_found(root, tmp_path, path, line, message):
    """`scripts/check_layers` accepts the sources, and refuses a use of a folder that its table does not allow."""
    (tmp_path / "scripts").mkdir()
    shutil.copy(root / "scripts/check_layers", tmp_path / "scripts")
    shutil.copytree(root / "src", tmp_path / "src")
    done = call(tmp_path / "scripts/check_layers")
    assert done.returncode == 0, done.stdout
    source = tmp_path / "src" / path
    source.write_text(source.read_text(encoding="utf-8") + line + "\n", encoding="utf-8")
    done = call(tmp_path / "scripts/check_layers")
    assert done.returncode == 1 and message in done.stdout, done.stdout


def test_functions_in_selectors_are_found(root, tmp_path):
    """gfortran 14 takes a function that stands below the selector for an external one."""
    for folder in ("scripts", "src", "tests"):
        (tmp_path / folder).mkdir()
    shutil.copy(root / "scripts/check_associate", tmp_path / "scripts")
    lines = ["module m", "contains", "subroutine s(x)", "real :: x(:)", "associate (y => &", "   x(place(1)))", "end associate",
             "end subroutine s", "pure integer function place(k)", "integer, intent(in) :: k", "place = k",
             "end function place", "end module m"]
    source = tmp_path / "src/m.f90"
    source.write_text("\n".join(lines) + "\n", encoding="utf-8")
    done = call(tmp_path / "scripts/check_associate")
    assert done.returncode == 1 and "src/m.f90:5:" in done.stdout and "place" in done.stdout
    source.write_text("\n".join(lines[:2] + lines[8:12] + lines[2:8] + lines[12:]) + "\n", encoding="utf-8")
    assert call(tmp_path / "scripts/check_associate").returncode == 0
    assert call(root / "scripts/check_associate").returncode == 0


@pytest.mark.parametrize("line", ["call t(b%v(place(b))%x(:, 1))", "y = f(b%v(place(b))%x(1, :))", "call t(x(:, max(1, k - 1)))",
                                  "call t(x(:, k, findloc(y, 1, 1)))", "associate (y => x(minval(k), :))"])
def test_functions_in_subscripts_of_sections_are_found(root, tmp_path, line):
    """gfortran 14 with -fcheck=bounds reads what they need before it is set, where the section is an argument."""
    for folder in ("scripts", "src", "tests"):
        (tmp_path / folder).mkdir()
    shutil.copy(root / "scripts/check_associate", tmp_path / "scripts")
    source = tmp_path / "src/m.f90"
    source.write_text(f"module m\ncontains\nsubroutine s(b, x)\n{line}\nend subroutine s\nend module m\n", encoding="utf-8")
    done = call(tmp_path / "scripts/check_associate")
    assert done.returncode == 1 and "src/m.f90:4: a section" in done.stdout
    source.write_text("module m\nreal :: x(0:3, max(1, n))\ncontains\nsubroutine s(b, x)\ncall t(b%v(place(b))%x, x(:, k), max(k, 1))\n"
                      "end subroutine s\nend module m\n", encoding="utf-8")
    assert call(tmp_path / "scripts/check_associate").returncode == 0


def test_a_folder_of_others_is_no_debian(root, tmp_path):
    if os.geteuid() != 0 or not shutil.which("debootstrap"):
        pytest.skip("needs root and debootstrap")
    folder = tmp_path / "precious"
    folder.mkdir()
    (folder / "thesis.txt").write_text("ten years of work\n", encoding="utf-8")
    done = call(root / "scripts/test_debian", "trixie", folder)
    assert done.returncode == 1 and "not made by this script" in done.stderr
    assert (folder / "thesis.txt").exists()
    (folder / ".made_by_test_debian").write_text("bookworm\n", encoding="utf-8")
    done = call(root / "scripts/test_debian", "trixie", folder)
    assert done.returncode == 1 and "holds bookworm" in done.stderr
    assert (folder / "thesis.txt").exists()


def test_debian_says_what_it_needs(root, tmp_path):
    done = call(root / "scripts/test_debian")
    assert done.returncode == 1 and "SUITE" in done.stderr
    done = call(root / "scripts/test_debian", "Trixie; rm", tmp_path / "x")
    assert done.returncode == 1 and "no suite" in done.stderr
    assert not (tmp_path / "x").exists()


@pytest.mark.parametrize("method", ["adams", "bdf", "ida"])
def test_libraries_write_no_messages(gudgeon, tmp_path, method):
    """A failed step of SUNDIALS is told by the program; SUNDIALS 6 and 7 would each write lines of their own."""
    text = (ROOT / "inputs/slider_crank_dry.deck").read_text(encoding="utf-8")
    deck = written(tmp_path, changed(text, "analysis.dynamic", minimum_step="0.5 ms", initial_step="0.5 ms"))
    done = call_gudgeon(gudgeon, "run", deck, "--method", method, "--write", "numbers", "--out", tmp_path / "out", expect=5)
    lines = done.stderr.splitlines()
    assert lines[0].startswith("error: the error exceeds the tolerance even at the minimum step")
    assert all(line.startswith("  = ") for line in lines[1:])
