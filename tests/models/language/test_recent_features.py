import torch

from models.language.recent_features import RecentFeatures


def test_a_hint_is_read_once_while_it_is_remembered() -> None:
    read = []

    def lengths(sentences):
        read.extend(sentences)
        return torch.tensor([[float(len(s))] for s in sentences])

    cache = RecentFeatures(lengths, 2)
    assert {k: v.item() for k, v in cache(["a", "bb", "a"]).items()} == {"a": 1, "bb": 2}
    assert [v.item() for v in cache(["ccc", "a"]).values()] == [3, 1]
    cache(["bb"])
    assert read == ["a", "bb", "ccc", "bb"], "the oldest was forgotten"
    assert len(cache) == 2
    cache.clear()
    assert not len(cache)
