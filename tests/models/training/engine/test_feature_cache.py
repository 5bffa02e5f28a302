import pytest
import torch

from models.files import cache_directory
from models.training.engine.feature_cache import frozen_features

SENTENCES = ["I stand on a gray road.", "There is a park to my west.", "A wall."]


class Counting:
    """A text encoder that counts what it is asked."""

    def __init__(self, encoder, fingerprint="a") -> None:
        self.encoder, self.fingerprint, self.encoded = encoder, fingerprint, 0

    def __call__(self, sentences):
        self.encoded += len(sentences)
        return self.encoder(sentences)


@pytest.fixture(autouse=True)
def directory(tmp_path, monkeypatch):
    monkeypatch.setenv("HEREABOUTS_CACHE_DIR", str(tmp_path / "cache"))
    return tmp_path / "cache"


def test_features_are_computed_once(text_encoder) -> None:
    first, second = Counting(text_encoder), Counting(text_encoder)
    computed, read = frozen_features(first, SENTENCES), frozen_features(second, SENTENCES)
    assert (first.encoded, second.encoded) == (3, 0)
    direct = text_encoder(SENTENCES)
    for features in (computed, read):
        assert torch.equal(features.values, direct.values.half())
        assert torch.equal(features.mask, direct.mask)
        assert torch.equal(features.ids, direct.ids)


def test_another_encoder_or_other_sentences_are_computed_anew(text_encoder) -> None:
    frozen_features(Counting(text_encoder), SENTENCES)
    other, fewer = Counting(text_encoder, "b"), Counting(text_encoder)
    frozen_features(other, SENTENCES)
    frozen_features(fewer, SENTENCES[:2])
    assert (other.encoded, fewer.encoded) == (3, 2)


def test_a_broken_file_is_computed_again(text_encoder, directory) -> None:
    frozen_features(Counting(text_encoder), SENTENCES)
    [path] = directory.rglob("*.safetensors")
    path.write_bytes(path.read_bytes()[:100])
    again, after = Counting(text_encoder), Counting(text_encoder)
    frozen_features(again, SENTENCES)
    frozen_features(after, SENTENCES)
    assert (again.encoded, after.encoded) == (3, 0)


def test_a_cache_that_cannot_be_written_is_done_without(text_encoder, directory) -> None:
    directory.write_text("not a directory")
    assert len(frozen_features(Counting(text_encoder), SENTENCES).mask) == 3


def test_where_the_cache_is(monkeypatch, tmp_path) -> None:
    monkeypatch.delenv("HEREABOUTS_CACHE_DIR")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    assert cache_directory() == tmp_path / "hereabouts"
    monkeypatch.delenv("XDG_CACHE_HOME")
    assert cache_directory().parts[-2:] == (".cache", "hereabouts")
