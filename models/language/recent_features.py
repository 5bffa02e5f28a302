"""A cache of features of sentences or phrases, so that the frozen text encoder runs only for new ones."""

from collections import OrderedDict
from collections.abc import Callable, Iterable, Sequence

from torch import Tensor

SENTENCES_PER_BATCH = 256


class RecentFeatures:
    """A cache of the features [D] of `size` sentences or phrases; the least recently used are dropped."""

    def __init__(self, read: Callable[[Sequence[str]], Tensor], size: int) -> None:
        self._read, self._size = read, size
        self._features: OrderedDict[str, Tensor] = OrderedDict()

    def __len__(self) -> int:
        return len(self._features)

    def __call__(self, sentences: Iterable[str]) -> dict[str, Tensor]:
        """Return features [D] of each distinct sentence."""
        wanted = list(dict.fromkeys(sentences))
        missing = [sentence for sentence in wanted if sentence not in self._features]
        for start in range(0, len(missing), SENTENCES_PER_BATCH):
            batch = missing[start : start + SENTENCES_PER_BATCH]
            self._features.update(zip(batch, self._read(batch), strict=True))
        features = {}
        for sentence in wanted:
            self._features.move_to_end(sentence)
            features[sentence] = self._features[sentence]
        while len(self._features) > self._size:
            self._features.popitem(last=False)
        return features

    def remember(self, sentences: Iterable[str], features: Iterable[Tensor]) -> None:
        """Add features that are known already."""
        self._features.update(zip(sentences, features, strict=True))

    def clear(self) -> None:
        """Drop all features, because the weights change."""
        self._features.clear()
