"""Saving and loading of fine stages."""

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
    "train weights with 'hereabouts train --method regressor' (or matching) and set HEREABOUTS_FINE_WEIGHTS_DIR "
    "to their directory, or use the centre of the cell as the position",
    is_int8=True,
)
save_fine, load_fine = FINE_STAGES.save, FINE_STAGES.load


def load_refiner(method: FineMethod, directory: Path | None = None) -> FineModel:
    """Load a fine stage of a method: from `directory` if its weights are of that method, else the shipped one.

    Raises:
        WeightsError: the directory or the weights in it cannot be read.
    """
    custom = load_fine(directory) if directory else None
    return custom if custom and custom.method == method else load_fine(SHIPPED_WEIGHTS_DIR / method)
