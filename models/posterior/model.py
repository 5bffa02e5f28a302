"""Everything that the hint posterior has learned, in one model: reader, names of labels, likelihood."""

import hashlib
from typing import ClassVar

from models.checkpoint import SHIPPED_WEIGHTS_DIR, Checkpoints
from models.language.labels import LabelMatcher
from models.language.mentions.cue_reader import CueReader
from models.language.reader import Reader, ReaderConfig
from models.language.text_encoder import TextEncoder, TextEncoderModel, fingerprint_of
from models.posterior.certainty import Certainty
from models.posterior.distribution import RADIUS_MASSES
from models.posterior.likelihood import Likelihood
from models.posterior.places.kernels import PlaceKernels


class PosteriorConfig(ReaderConfig):
    """Shape and calibration."""

    # Mass that must lie within radii for them to contain .5 and .9 of the truths; from validation data.
    radius_held: tuple[float, float] = RADIUS_MASSES
    # Of texts that name places; fitted to texts by language models and by people about many cities.
    certainty: Certainty | None = None
    grammar_sha256: str = ""  # of the phrases that the reader was trained on


class PosteriorModel(TextEncoderModel):
    """The parts of the hint posterior that do not depend on a map."""

    method: ClassVar[str] = "posterior"
    config_type: ClassVar[type[PosteriorConfig]] = PosteriorConfig

    def __init__(self, text_encoder: TextEncoder, config: PosteriorConfig) -> None:
        super().__init__(text_encoder)
        self.config = config
        self.reader = Reader(text_encoder, config)
        self.matcher = LabelMatcher(text_encoder)
        self.likelihood = Likelihood()
        self.cues = CueReader(text_encoder, self.reader.tuned, config.frozen_layers)
        self.places = PlaceKernels()

    @property
    def fingerprint(self) -> str:
        """sha256 of all weights, the frozen ones included, and of the lexicon, from which the names' vectors follow."""
        parts = fingerprint_of(dict(self.named_parameters())), self.text_encoder.fingerprint
        return hashlib.sha256("".join([*parts, self.matcher.lexicon.sha256]).encode()).hexdigest()


POSTERIORS = Checkpoints(
    "posterior",
    {PosteriorModel.method: PosteriorModel},
    SHIPPED_WEIGHTS_DIR / "posterior",
    "train some with 'hereabouts train --method posterior', or leave the setting out for those that ship",
)
save_posterior, load_posterior = POSTERIORS.save, POSTERIORS.load
