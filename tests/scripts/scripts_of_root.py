"""Scripts of scripts/ as modules."""

import importlib.machinery
import importlib.util

from conftest import ROOT


def load(name):
    """A script without a suffix."""
    loader = importlib.machinery.SourceFileLoader(name, str(ROOT / "scripts" / name))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(name, loader))
    loader.exec_module(module)
    return module
