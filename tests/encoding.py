"""Texts as a retriever encodes them."""

import numpy as np


def encode_descriptions(retriever, descriptions):
    """[Q, D] unit vectors of descriptions at the global level."""
    return np.concatenate([text.global_vectors.cpu().numpy() for text in retriever.encode_texts(descriptions)])
