"""Saving and loading models of the fine stage."""

from models.checkpoint import SHIPPED, Checkpoints
from models.localization.fine_model import FineModel
from models.localization.matching import Matching
from models.localization.regressor import Regressor

FINE_METHODS: dict[str, type[FineModel]] = {"regressor": Regressor, "matching": Matching}
FINE_STAGES = Checkpoints(
    "fine",
    FINE_METHODS,
    SHIPPED / "regressor",
    "train some with 'hereabouts train --method regressor', or leave the position at the cell's centre",
)
save_fine, load_fine = FINE_STAGES.save, FINE_STAGES.load
