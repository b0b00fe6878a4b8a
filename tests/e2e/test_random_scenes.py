"""Random scenes whose contacts begin together, a few of each kind by every method; `make stability` runs hundreds."""

import sys

import pytest
from support import ROOT, scratch

sys.path.insert(0, str(ROOT / "tests" / "stability"))
from random_runs import METHODS, mistakes_of  # noqa: E402
from random_scenes import KINDS, draw  # noqa: E402

EACH = 4  # scenes of a kind


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("kind", KINDS)
def test_contacts_that_begin_together(gudgeon, kind, method):
    """No failure, no impact that is none, energy kept; the impacts of a fall without spin are those of one mass on springs."""
    for seed in range(EACH):
        mistakes = mistakes_of(gudgeon, draw(kind, seed), method, scratch())
        assert not mistakes, f"{kind} {seed}, {method}: {'; '.join(mistakes)}"
