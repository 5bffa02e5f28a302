"""Saving and loading models of the fine stage."""

from pathlib import Path

from models.checkpoint import SHIPPED_WEIGHTS_DIR, Checkpoints
from models.paper.fine.fine_model import FineMethod, FineModel
from models.paper.fine.matching import Matching
from models.paper.fine.regressor import Regressor

FINE_METHODS: dict[str, type[FineModel]] = {"regressor": Regressor, "matching": Matching}
FINE_STAGES = Checkpoints(
    "fine",
    FINE_METHODS,
    SHIPPED_WEIGHTS_DIR / "regressor",
    "train some with 'hereabouts train --method regressor' (or matching) and name their directory in "
    "HEREABOUTS_FINE_WEIGHTS_DIR, or leave the position at the cell's centre",
    is_int8=True,
)
save_fine, load_fine = FINE_STAGES.save, FINE_STAGES.load


def load_refiner(method: FineMethod, directory: Path | None = None) -> FineModel:
    """The fine stage of a method: from a directory of weights, if they are of that method, else the one that ships.

    Raises:
        WeightsError: the directory or the weights in it cannot be read.
    """
    given = load_fine(directory) if directory else None
    return given if given and given.method == method else load_fine(SHIPPED_WEIGHTS_DIR / method)
