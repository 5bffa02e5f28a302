"""Texts as a retriever encodes them, and a text encoder that is no MiniLM."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from tokenizers import Tokenizer, models, pre_tokenizers


def encode_descriptions(retriever, descriptions):
    """[Q, D] unit vectors of descriptions at the global level."""
    return np.concatenate([text.global_vectors.cpu().numpy() for text in retriever.encode_texts(descriptions)])


def write_tiny_t5(directory: Path, words: Sequence[str]) -> None:
    """An untrained T5 of one layer that knows some words."""
    from transformers import PreTrainedTokenizerFast, T5Config, T5EncoderModel

    vocabulary = {word: n for n, word in enumerate(["<pad>", "</s>", "<unk>", *words])}
    tokenizer = Tokenizer(models.WordLevel(vocabulary, unk_token="<unk>"))
    tokenizer.pre_tokenizer = pre_tokenizers.Whitespace()
    fast = PreTrainedTokenizerFast(tokenizer_object=tokenizer, pad_token="<pad>", eos_token="</s>", unk_token="<unk>")
    fast.save_pretrained(directory)
    config = T5Config(vocab_size=len(vocabulary), d_model=16, d_kv=8, d_ff=32, num_layers=1, num_heads=2)
    T5EncoderModel(config).save_pretrained(directory)
