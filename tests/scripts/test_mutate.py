"""scripts/mutate: what is changed in a line, and what never is."""

import pytest
from scripts_of_root import load

mutate = load("mutate")


@pytest.mark.parametrize(("line", "expected"), [
    ("a = b + c", ["a = b - c"]),
    ("a = -b", ["a = b"]),
    ("a = b*c", ["a = b/c"]),
    ("a = b**2", ["a = b**3"]),
    ("a = 2.0_wp", ["a = 2.02_wp"]),
    ("a = 0.0_wp", ["a = 1.0_wp"]),
    ("is_done = .true.", ["is_done = .false."]),
    ("a = max(b, c)", ["a = min(b, c)"]),
    ("if (a < b) return", ["if (a <= b) return", "if (.not. (a < b)) return"]),
    ("else if (is_a .and. is_b) then", ["else if (is_a .or. is_b) then", "else if (.not. (is_a .and. is_b)) then"]),
    ("if (a(1) == 1) then", ["if (a(1) /= 1) then", "if (a(2) == 1) then", "if (a(1) == 2) then", "if (.not. (a(1) == 1)) then"]),
    ("if (is_a .or. &", ["if (is_a .and. &"]),
])
def test_changed(line, expected):
    """Each operator, constant and condition once, and nothing else."""
    assert mutate.mutations_of(line) == expected


@pytest.mark.parametrize("line", [
    "! a = b + 1", "use kinds, only: wp", "real(wp), intent(in) :: a(3)", 'call say("1 + 2")', "call f(x, '1 < 2')  ! a + b",
    "p => q(2)", "end if", "call f(a(:, i))", "x2 = r1%y3", "return", "subroutine f(a)", "10 format (3i5)",
])
def test_unchanged(line):
    """Comments, texts, declarations, pointers, names with digits."""
    assert mutate.mutations_of(line) == []


def test_statements():
    """No line of the declarations of a module or a procedure, nor their continuations."""
    text = "module a\ninteger, parameter :: b = 1\ncontains\nsubroutine c(d)\nreal :: d(2), &\n e(3)\nd = 1.0\nend subroutine c\n"
    assert list(mutate.statements(text)) == [6]
    assert list(mutate.statements("d = 1.0\n", is_included=True)) == [0]


def test_report(capsys):
    """Survivors with place, before and after; percentages."""
    mutants = [{"file": "src/a.f90", "line": 3, "before": "  a = b + c", "after": "  a = b - c", "fate": "survived", "test": ""},
               {"file": "src/a.f90", "line": 4, "before": "x", "after": "y", "fate": "quick", "test": "t"}]
    mutate.report(mutants)
    assert capsys.readouterr().out.splitlines() == [
        "src/a.f90:3", "  - a = b + c", "  + a = b - c", "killed by quick: 1 of 2 (50 %)", "killed by test: 0 of 2 (0 %)",
        "survived: 1 of 2 (50 %)"]
