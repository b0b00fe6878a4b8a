"""Each Fortran test is one item here. The test program runs once per build and its lines are shared out.

The debug build runs everything, as that with the sanitizers does. The release build runs the folders whose claims depend on the
optimiser; in `make quick`, where it is the only build, everything.
"""

import concurrent.futures
import functools
import re
import subprocess

import pytest
from conftest import DIRECTORY, ROOT

RELEASE_FOLDERS = ("identity", "order")
LIMIT = 1800  # seconds for one run of the test program
LINE = re.compile(r"(PASS|FAIL) ([a-z]\w*\.[^\s:]+)(?:: (.*))?$", re.IGNORECASE)


def program(mode):
    """The test program of one build."""
    return DIRECTORY[mode] / "tests" / "run_tests"


def modules(folders):
    """Names of the test modules in these folders of tests/."""
    return [path.stem for folder in folders for path in sorted((ROOT / "tests" / folder).glob("test_*.f90"))]


def listed(mode, selection):
    """Names `module.test` that the program knows."""
    if not program(mode).exists():
        return []
    command = [program(mode), "--list", *selection]
    text = subprocess.run(command, capture_output=True, text=True, check=True, timeout=60).stdout
    return text.split()


@functools.lru_cache(maxsize=None)
def plan():
    """For each build: which modules to run (none named: all) and the names of their tests."""
    if len(DIRECTORY) == 1:
        return {mode: ([], listed(mode, [])) for mode in DIRECTORY}
    release = modules(RELEASE_FOLDERS)
    return {
        "debug": ([], listed("debug", [])),
        "release": (release, listed("release", release) if release else []),
    }


def run(mode):
    """Run the test program; return its verdicts by name and a note for those that it never reached."""
    try:
        done = subprocess.run(
            [program(mode), *plan()[mode][0]], capture_output=True, text=True, errors="replace", timeout=LIMIT
        )
    except subprocess.TimeoutExpired:
        return {}, f"the test program took longer than {LIMIT} s"
    verdicts = {}
    name = None
    for line in done.stdout.splitlines():
        match = LINE.match(line)
        if match:
            name = match[2]
            verdicts[name] = (match[1] == "PASS", match[3] or "")
        elif name and not verdicts[name][0]:  # further lines of a message
            verdicts[name] = (False, verdicts[name][1] + "\n" + line)
    tail = "\n".join(done.stderr.splitlines()[-30:])
    ended = f"the test program ended with code {done.returncode}"
    missing = [name for name in plan()[mode][1] if name not in verdicts]
    for name in missing[:1]:
        verdicts[name] = (False, f"{ended} here\n{tail}")
    return verdicts, f"not reached: {ended} in {''.join(missing[:1])}"


@functools.lru_cache(maxsize=None)
def started():
    """Both builds' test programs, running side by side."""
    pool = concurrent.futures.ThreadPoolExecutor()
    return {mode: pool.submit(run, mode) for mode, (_, names) in plan().items() if names}


def pytest_generate_tests(metafunc):
    """One item per Fortran test and build."""
    if "fortran_test" in metafunc.fixturenames:
        pairs = [(mode, name) for mode, (_, names) in plan().items() for name in names]
        metafunc.parametrize("fortran_test", pairs, ids=[f"{mode}:{name}" for mode, name in pairs])


@pytest.mark.parametrize("mode", DIRECTORY)
def test_program_has_tests(mode):
    """No Fortran tests found is a failure, not a success; neither may two tests share a name."""
    assert program(mode).exists(), f"{program(mode)} is not there: run `make test`, which builds it"
    names = listed(mode, [])
    assert names, "the test program knows no tests"
    assert len(set(names)) == len(names), f"names used twice: {sorted({n for n in names if names.count(n) > 1})}"
    silent = set(modules(["unit", "identity", "order", "invariance"])) - {name.split(".")[0] for name in names}
    assert not silent, f"modules without a test: {sorted(silent)}"


def test_fortran(fortran_test):
    """The verdict of one Fortran test."""
    mode, name = fortran_test
    verdicts, unreached = started()[mode].result()
    passed, message = verdicts.get(name, (False, unreached))
    if not passed:
        pytest.fail(f"{name} ({mode} build): {message}", pytrace=False)
