"""The errors a user can meet; each message says what is wrong and what to do next.

HereaboutsError
├── MapError             a map that cannot be read or holds nothing usable
├── DataError            data set files that cannot be read; the message names file and field
├── DescriptionError     a text that cannot be used as a description
├── ReplyError           an answer to a question that the service did not ask
├── WeightsError         weights that are missing, broken or of another model
├── StoreUnavailable     a store of vectors elsewhere that does not answer, or cannot be asked
├── ClusterUnavailable   a cluster of machines that does not answer, or cannot be asked
├── TrainingError        settings that cannot be trained with, or a run directory of another run
└── IndexUnusable         an index directory that cannot be served
    ├── IndexBroken      missing, cut short or changed after it was written
    └── IndexMismatch    built by another model
"""


class HereaboutsError(Exception):
    """Anything that goes wrong because of the input, not because of a bug."""


class MapError(HereaboutsError):
    """A map that cannot be read or holds nothing usable."""


class DataError(HereaboutsError):
    """Data set files that cannot be read; the message names the file and the field."""


class DescriptionError(HereaboutsError):
    """A text that cannot be used as a description."""


class ReplyError(HereaboutsError):
    """An answer to a question that cannot have been asked about this map.

    Attributes:
        number: of the answer, among those of its query, from 0.
        field: what of it is wrong, "question" or "choice".
        advice: what to do.
    """

    def __init__(self, number: int, field: str, advice: str) -> None:
        super().__init__(f"answers[{number}].{field}: {advice}")
        self.number, self.field, self.advice = number, field, advice

    def __reduce__(self) -> tuple[type["ReplyError"], tuple[int, str, str]]:
        """What another process makes it of again."""
        return type(self), (self.number, self.field, self.advice)


class WeightsError(HereaboutsError):
    """Weights that are missing, broken or of another model."""


class StoreUnavailable(HereaboutsError):
    """A store of vectors outside the index directory that does not answer; it may the next time."""


class ClusterUnavailable(HereaboutsError):
    """A cluster that does not answer, cannot be asked, or lost what it was asked for; it may have it the next time."""


class TrainingError(HereaboutsError):
    """Settings that cannot be trained with, a run that went astray, or a run directory of another run."""


class IndexUnusable(HereaboutsError):
    """An index directory that cannot be served."""


class IndexBroken(IndexUnusable):
    """An index directory that is missing, cut short, or changed after it was written."""


class IndexMismatch(IndexUnusable):
    """An index built by a model other than the one that is loaded."""
