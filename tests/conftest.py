"""What every Python test may use: the programs that `make test` has built, and the project's directory."""

import os
import pathlib
import sys

import pytest

sys.dont_write_bytecode = True

ROOT = pathlib.Path(__file__).resolve().parent.parent
BUILD = pathlib.Path(os.environ.get("GUDGEON_BUILD", ROOT / "build")).resolve()
DIRECTORY = {"release": BUILD, "debug": BUILD / "debug"}

os.environ["OPENBLAS_NUM_THREADS"] = "1"


def built(path):
    """The program, or a failure that says how to make it."""
    if not path.exists():
        pytest.fail(f"{path} is not there: run `make test`, which builds it", pytrace=False)
    return path


@pytest.fixture
def root():
    """The project's directory."""
    return ROOT


@pytest.fixture
def gudgeon():
    """The release build of the program."""
    return built(DIRECTORY["release"] / "gudgeon")


@pytest.fixture
def gudgeon_debug():
    """The program built with all run-time checks."""
    return built(DIRECTORY["debug"] / "gudgeon")
