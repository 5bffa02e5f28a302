"""The ways in which descriptions and maps are made hard."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from models.citymap.gallery import MapData
from models.citymap.templates import TEMPLATES, render_hint
from models.citymap.types import DIRECTIONS, Direction, Hint
from models.language.grammar.labelled_text import Fact, LabelledText
from models.language.grammar.typos import typos
from models.language.grammar.wording import Wording

TEMPLATE, FREE = CANDIDATES_OF = ("template text", "free wording, unseen grammar")
INVERSE = TEMPLATES.index("There is {a} {o} of me.")
Say = Callable[[tuple[Hint, ...], np.random.Generator], tuple[str, ...]]
Change = Callable[[tuple[Hint, ...], np.random.Generator], tuple[Hint, ...]]


@dataclass(frozen=True, slots=True)
class Trial:
    """One way to make it hard.

    Attributes:
        name: for the table.
        say: what is said of a query's hints.
        hints: tell of so many things instead of the query's own hints, the nearest ones.
        dropped, relabelled: shares of the map's instances that are gone, or have another's label.
    """

    name: str
    say: Say
    hints: int | None = None
    dropped: float = 0.0
    relabelled: float = 0.0


def all_trials(data: MapData) -> list[Trial]:
    """Every trial."""
    words = sorted(set(data.palette.words))
    free = Wording("test")
    trials = [Trial(TEMPLATE, _template)]
    trials += [Trial(f"{n} hints", _first(n)) for n in range(1, 6)]
    trials += [
        Trial("12 hints", _template, hints=12),
        Trial("one hint of six wrong", _one_wrong(words)),
        Trial("two colours of six wrong", _wrong_colours(words, 2)),
        Trial("hints in another order", _shuffled),
        Trial("inverse phrasing", lambda hints, _rng: tuple(render_hint(hint, INVERSE) for hint in hints)),
        Trial(FREE, lambda hints, rng: _pieces(_write(free, hints, rng))),
        Trial("free wording, three typos", lambda hints, rng: _pieces(typos(_write(free, hints, rng), 3, rng))),
    ]
    trials += [Trial(f"free wording, {n} hints", _freely(free, _some(n))) for n in (2, 3, 4)]
    trials += [
        Trial("free wording, 3 hints, no colours", _freely(free, lambda hints, rng: _plain(_some(3)(hints, rng)))),
        Trial("free wording, one hint of six wrong", _freely(free, _with_one_wrong(words))),
    ]
    trials += [Trial(f"{share:.0%} of the instances gone", _template, dropped=share) for share in (0.1, 0.2)]
    trials += [Trial(f"{share:.0%} of the labels wrong", _template, relabelled=share) for share in (0.1, 0.2)]
    return trials


def _template(hints: tuple[Hint, ...], _rng: np.random.Generator) -> tuple[str, ...]:
    return tuple(render_hint(hint) for hint in hints)


def _first(count: int) -> Say:
    return lambda hints, rng: _template(_some(count)(hints, rng), rng)


def _some(count: int) -> Change:
    return lambda hints, rng: tuple(hints[i] for i in rng.permutation(len(hints))[:count])


def _plain(hints: tuple[Hint, ...]) -> tuple[Hint, ...]:
    return tuple(replace(hint, colour=None) for hint in hints)


def _freely(wording: Wording, change: Change) -> Say:
    return lambda hints, rng: _pieces(_write(wording, change(hints, rng), rng))


def _shuffled(hints: tuple[Hint, ...], rng: np.random.Generator) -> tuple[str, ...]:
    return _template(tuple(hints[i] for i in rng.permutation(len(hints))), rng)


def _one_wrong(words: Sequence[str]) -> Say:
    return lambda hints, rng: _template(_with_one_wrong(words)(hints, rng), rng)


def _with_one_wrong(words: Sequence[str]) -> Change:
    """One hint says another direction and another colour than is true."""

    def change(hints: tuple[Hint, ...], rng: np.random.Generator) -> tuple[Hint, ...]:
        at = int(rng.integers(len(hints)))
        others: list[Direction] = [d for d in DIRECTIONS[:4] if d != hints[at].direction]
        wrong = replace(
            hints[at], direction=others[int(rng.integers(len(others)))], colour=_other(words, hints[at], rng)
        )
        return (*hints[:at], wrong, *hints[at + 1 :])

    return change


def _wrong_colours(words: Sequence[str], count: int) -> Say:
    def say(hints: tuple[Hint, ...], rng: np.random.Generator) -> tuple[str, ...]:
        at = set(rng.permutation(len(hints))[:count].tolist())
        wrong = (replace(h, colour=_other(words, h, rng)) if n in at else h for n, h in enumerate(hints))
        return _template(tuple(wrong), rng)

    return say


def _other(words: Sequence[str], hint: Hint, rng: np.random.Generator) -> str:
    others = [word for word in words if word != hint.colour]
    return others[int(rng.integers(len(others)))]


def _write(wording: Wording, hints: tuple[Hint, ...], rng: np.random.Generator) -> LabelledText:
    return wording.write([Fact(hint.label, hint.direction, hint.colour) for hint in hints], rng)


def _pieces(said: LabelledText) -> tuple[str, ...]:
    return tuple(line for line in said.text.split("\n") if line.strip())
