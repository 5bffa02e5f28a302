"""The point branch that retrievers and fine stages share: its options, and the features of a model's cells."""

from typing import Any, TypeVar

from pydantic import ValidationInfo

from models.language.text_encoder import TextEncoderModel
from models.paper.instance_encoder import CellBatch, CellFeatures, UncutCells
from models.paper.point_encoder import PointEncoder

Cells = TypeVar("Cells", CellFeatures, UncutCells)


def check_point_option(cls: Any, value: Any, info: ValidationInfo) -> Any:
    """Refuse an option of the point encoder, other than its default, for a model without one (a pydantic validator)."""
    is_default = value == cls.model_fields[info.field_name].default
    if not is_default and "points" not in info.data.get("inputs", ("points",)):
        raise ValueError("it is for models with point inputs; add points to model.inputs")
    return value


def build_point_encoder(config: Any) -> PointEncoder | None:
    """Return an untrained, frozen point encoder for a configuration with point inputs; else None."""
    return PointEncoder(config.point_encoder).requires_grad_(False) if "points" in config.inputs else None


class PointModel(TextEncoderModel):
    """A model with a point encoder, if its configuration has point inputs."""

    points: PointEncoder | None

    @property
    def draws_points(self) -> bool:
        """Whether each training step draws points of its cells and encodes them.

        A frozen encoder of unit balls does not need it: its features, computed once, stay the same if a cell is turned.
        """
        return self.points is not None and (not self.config.points_frozen or self.points.frame == "cell")

    def with_point_features(self, cells: Cells) -> Cells:
        """Return cells with the features of the point encoder, or unchanged if the model has none.

        Raises:
            WeightsError: the model has a point encoder, but the points are not available.
        """
        return cells.with_point_features(self.points)

    def encode_points(self, batch: CellBatch) -> CellBatch:
        """Return a batch with the features of its points, if it has points."""
        return batch.with_point_features(self.points)

    def validation_features(self, cells: CellFeatures) -> CellFeatures:
        """Return cells with the features of a point encoder in training; cells of another model are unchanged."""
        if self.points is None or self.config.points_frozen:
            return cells
        return cells.with_point_features(self.points, cached=False)
