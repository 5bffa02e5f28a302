"""The errors that a user can cause; each message says what is wrong and what to do next."""


class HereaboutsError(Exception):
    """Base of all errors that are caused by the input, not by a bug."""


class MapError(HereaboutsError):
    """A map that cannot be read or has nothing to index."""


class DataError(HereaboutsError):
    """Data set files that cannot be read; the message names the file and the field."""


class DescriptionError(HereaboutsError):
    """A text that cannot be used as a description."""


class ReplyError(HereaboutsError):
    """An answer to a question that the service cannot have asked about this map.

    `number` counts the answers of a query from 0; `field` is "question" or "choice".
    """

    def __init__(self, number: int, field: str, advice: str) -> None:
        super().__init__(f"answers[{number}].{field}: {advice}")
        self.number, self.field, self.advice = number, field, advice

    def __reduce__(self) -> tuple[type["ReplyError"], tuple[int, str, str]]:
        """Pickle with the constructor's arguments, not with the message."""
        return type(self), (self.number, self.field, self.advice)


class WeightsError(HereaboutsError):
    """Weights that are missing, broken or of another model."""


class StoreUnavailable(HereaboutsError):
    """An external vector store that cannot be reached; a retry may succeed."""


class ClusterUnavailable(HereaboutsError):
    """A Ray cluster that cannot be reached or has lost a job; a retry may succeed."""


class TrainingError(HereaboutsError):
    """Invalid training settings, a diverging run, or a run directory of another run."""


class IndexUnusable(HereaboutsError):
    """An index directory that cannot be used."""


class IndexBroken(IndexUnusable):
    """An index directory that is missing, truncated or changed after it was written."""


class IndexMismatch(IndexUnusable):
    """An index that was built with another model than the loaded one."""
