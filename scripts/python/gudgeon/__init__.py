"""gudgeon in Python: runs decks, sweeps and comparisons of methods, and reads what they leave behind.

    import gudgeon

    run = gudgeon.run("crank.deck", set={"c": "0.1 mm"}, tolerance=1e-9)
    run["slider.velocity.x"]                  # an array, one number for each output time; run.channels: an xarray.Dataset
    run.contacts, run.extremes                # tables: pandas.DataFrame
    gudgeon.sweep("crank.deck", over={"c": ["0.1 mm", "0.2 mm"]})
    gudgeon.read("outputs/crank")             # a run that was made before

Runs need nothing but the program (`gudgeon.program()` says which), arrays h5py and numpy, tables pandas, datasets xarray.
"""

from .call import GudgeonError, program
from .deck import Deck
from .result import Run, read
from .tolerances import Tolerances, tolerance
from .verbs import fit, life, precision, run, sweep

__all__ = ["Deck", "GudgeonError", "Run", "Tolerances", "fit", "life", "precision", "program", "read", "run", "sweep", "tolerance"]
