"""Features of sentences or phrases that were read lately, so that the frozen text encoder runs only for new ones."""

from collections import OrderedDict
from collections.abc import Callable, Iterable, Sequence

from torch import Tensor

READ_BATCH = 256  # sentences


class RecentFeatures:
    """Features by sentence or phrase.

    Args:
        read: [S, D] features of S sentences.
        size: sentences to keep, those asked for last.
    """

    def __init__(self, read: Callable[[Sequence[str]], Tensor], size: int) -> None:
        self._read, self._size = read, size
        self._features: OrderedDict[str, Tensor] = OrderedDict()

    def __len__(self) -> int:
        return len(self._features)

    def __call__(self, sentences: Iterable[str]) -> dict[str, Tensor]:
        """[D] features of each different sentence."""
        asked = list(dict.fromkeys(sentences))
        missing = [sentence for sentence in asked if sentence not in self._features]
        for start in range(0, len(missing), READ_BATCH):
            batch = missing[start : start + READ_BATCH]
            self._features.update(zip(batch, self._read(batch), strict=True))
        found = {}
        for sentence in asked:
            self._features.move_to_end(sentence)
            found[sentence] = self._features[sentence]
        while len(self._features) > self._size:
            self._features.popitem(last=False)
        return found

    def remember(self, sentences: Iterable[str], features: Iterable[Tensor]) -> None:
        """Take up features that were read before."""
        self._features.update(zip(sentences, features, strict=True))

    def clear(self) -> None:
        """Forget all, because the weights change."""
        self._features.clear()
