"""The facts that a text and its replies have already stated."""

from collections.abc import Sequence
from dataclasses import dataclass

from index.answering.query import Reply
from index.asking.question_spec import OPEN_QUESTIONS, UNKNOWN, QuestionSpec
from models.citymap.gazetteer.gazetteer import Gazetteer
from models.language.mentions.mentions import Mention
from models.posterior.binding import LIKELY_PROBABILITY, MIN_LABEL_PROBABILITY
from models.posterior.likelihood import BoundHints


@dataclass(frozen=True, slots=True)
class KnownFacts:
    """Facts about the speaker's position that need no question."""

    labels: frozenset[str] = frozenset()  # classes that the text mentions
    winds: frozenset[str] = frozenset()  # the mentioned classes with a compass direction
    colours: frozenset[str] = frozenset()  # the mentioned classes with a colour
    names: frozenset[str] = frozenset()  # of the streets and places that the text names
    is_on_street: bool = False
    is_at_corner: bool = False  # whether the text names two streets that meet
    is_at_name: bool = False
    is_at_house: bool = False
    has_winds: bool = True  # whether the speaker seems to know where north is

    @classmethod
    def from_text(
        cls, bound_hints: BoundHints | None, mentions: Sequence[Mention], labels: Sequence[str], gazetteer: Gazetteer
    ) -> "KnownFacts":
        """Collect the facts that a text states."""
        labelled, with_wind, with_colour = set[str](), set[str](), set[str]()
        if bound_hints is not None:
            trust, number = bound_hints.label.max(dim=1)
            relation, colour = bound_hints.relation[:, :-1].sum(dim=1), 1 - bound_hints.colour[:, -1]
            for n in (trust >= MIN_LABEL_PROBABILITY).nonzero().flatten().tolist():
                label = labels[int(number[n])]
                labelled.add(label)
                with_wind |= {label} if relation[n] > LIKELY_PROBABILITY else set()
                with_colour |= {label} if colour[n] > LIKELY_PROBABILITY else set()
        labelled |= {kind.rsplit("/")[-1].replace("_", " ") for mention in mentions for kind in mention.kinds}
        return cls(
            labels=frozenset(labelled),
            winds=frozenset(with_wind),
            colours=frozenset(with_colour),
            names=frozenset(
                name
                for mention in mentions
                for number in (mention.objects.tolist() if mention.is_exact or mention.form == "street" else ())
                for name in gazetteer.objects[number].names
            ),
            is_on_street=any(mention.form in {"street", "address", "corner", "span"} for mention in mentions),
            is_at_corner=any(mention.form in {"corner", "span"} for mention in mentions),
            is_at_name=any(mention.form == "thing" and mention.is_exact for mention in mentions),
            is_at_house=any(mention.form == "address" for mention in mentions),
            has_winds=not len(gazetteer) or bool(with_wind) or any(m.cue.wind is not None for m in mentions),
        )

    def open_questions(self, replies: Sequence[Reply]) -> list[QuestionSpec]:
        """Return the open questions that neither the text nor the replies have answered."""
        before = {reply.question: reply.choice for reply in replies}
        is_on_street = self.is_on_street or any(before.get(kind, UNKNOWN) != UNKNOWN for kind in ("street", "address"))
        left = {
            "street": not is_on_street,
            "name": not self.is_at_name,
            "corner": is_on_street and not self.is_at_corner,
            "address": not self.is_at_house,
        }
        return [spec for spec in map(QuestionSpec, OPEN_QUESTIONS) if left[spec.kind] and spec.kind not in before]
