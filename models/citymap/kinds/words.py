"""The nouns by which people call kinds: of the packages and of the hand-written files."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any

from models.citymap.kinds.matching import Kind

NAME_WEIGHT, ALIAS_WEIGHT, TAG_WEIGHT, LOOSE_WEIGHT, TERM_WEIGHT = 1.0, 0.9, 0.8, 0.7, 0.5
Weights = dict[str, dict[str, float]]
Nouns = dict[str, tuple[tuple[str, float], ...]]
# How a kind is called after its tag, by the first part of its id.
TAG_PHRASES = {
    "shop": ("{} shop", "{} store"),
    "office": ("{} office",),
    "building": ("{} building",),
    "historic": ("historic {}",),
    **dict.fromkeys(("amenity", "leisure", "man_made", "natural", "tourism", "barrier", "craft"), ("{}",)),
}
# How people call places by whose food they have, and by what they have; the kind of the food, of the restaurant.
NATION_PHRASES = {
    "{} restaurant": (0.8, NAME_WEIGHT),
    **dict.fromkeys(
        ("{} place", "{} food", "{} eatery", "{} spot", "{} joint", "{} takeaway", "{} takeout"), (NAME_WEIGHT, 0)
    ),
    **dict.fromkeys(("{}", "a {}", "an {}", "{} cuisine", "{} kitchen"), (0.8, 0)),
}
DISH_PHRASES = {
    **dict.fromkeys(
        ("{} place", "{} joint", "{} shop", "{} spot", "{} restaurant", "{} bar", "{} store"), (NAME_WEIGHT, 0)
    ),
    **dict.fromkeys(
        ("{} house", "{} stand", "{} parlor", "{} parlour", "{} counter", "{} takeaway"), (ALIAS_WEIGHT, 0)
    ),
    "{}": (0.6, 0),
}
# Endings that one says for another.
INTERCHANGEABLE_ENDINGS = ((" store", " shop"), (" shop", " store"), (" center", " centre"), (" parlor", " parlour"))


def additional_kinds(ours: Mapping[str, Any], taken: Iterable[Kind]) -> Iterator[Kind]:
    """The kinds that the packages lack: those listed, cuisines, restaurants of cuisines, churches of denominations."""
    seen = [kind.tags for kind in taken]
    found = [Kind(key, row["name"], row["tags"]) for key, row in ours["kinds"].items()]
    for values, words in {**ours["nations"], **ours["dishes"]}.items():
        found += [Kind(f"cuisine/{value}", f"{words[0]} food", {"cuisine": value}) for value in values.split("|")]
    for values, words in ours["nations"].items():
        for value in values.split("|"):
            tags = {"amenity": "restaurant", "cuisine": value}
            found.append(Kind(f"amenity/restaurant/{value}", f"{words[0]} restaurant", tags))
    for values, words in ours["denominations"].items():
        for value in values.split("|"):
            tags = {"amenity": "place_of_worship", "religion": "christian", "denomination": value}
            found.append(Kind(f"amenity/place_of_worship/christian/{value}", f"{words[0]} church", tags))
    return (kind for kind in found if kind.tags not in seen)


def everyday_nouns(people: Mapping[str, Any]) -> Weights:
    """What people.toml says: "phrase, phrase" = "kind kind~ kind~0.6 @group"; ~ is loosely."""
    said: Weights = {}
    for phrases, kinds in people["words"].items():
        rows: dict[str, float] = {}
        for one in kinds.split():
            key, loose, weight = one.partition("~")
            for member in people["groups"][key[1:]] if key.startswith("@") else [key]:
                rows[member] = max(rows.get(member, 0), float(weight or LOOSE_WEIGHT) if loose else NAME_WEIGHT)
        for phrase in phrases.split(","):
            add_meanings(said, phrase.strip().casefold(), rows)
    return said


def add_meanings(nouns: Weights, phrase: str, rows: Mapping[str, float]) -> None:
    """Let a phrase mean kinds, too; the higher weight counts."""
    kinds = nouns.setdefault(phrase, {})
    for key, weight in rows.items():
        if weight > kinds.get(key, 0):
            kinds[key] = weight


def food_nouns(ours: Mapping[str, Any], by_tags: Mapping[tuple[str, str], str]) -> Weights:
    """What places are called by their food: "thai place", "pizza joint"."""
    said: Weights = {}
    for part, ways in (("nations", NATION_PHRASES), ("dishes", DISH_PHRASES)):
        for values, words in ours[part].items():
            for value in values.split("|"):
                restaurant = by_tags.get(("restaurant", value), "")
                for word in words:
                    for way, weights in ways.items():
                        pairs = zip((f"cuisine/{value}", restaurant), weights, strict=True)
                        add_meanings(said, way.format(word), {key: weight for key, weight in pairs if key and weight})
    return said


def church_nouns(ours: Mapping[str, Any]) -> Weights:
    """What churches are called by their denomination."""
    said: Weights = {}
    for values, words in ours["denominations"].items():
        for key in (f"amenity/place_of_worship/christian/{value}" for value in values.split("|")):
            for word in words:
                add_meanings(said, f"{word} church", {key: NAME_WEIGHT})
                add_meanings(said, f"{word} parish", {key: TAG_WEIGHT})
    return said


def preset_nouns(row: Mapping[str, Any]) -> Iterator[tuple[str, float]]:
    """What a preset is called in English."""
    first, _, rest = row["id"].partition("/")
    if rest and "/" not in rest and list(row["tags"].items()) == [(first, rest)]:
        for way in TAG_PHRASES.get(first, ()):
            yield way.format(rest.replace("_", " ")), TAG_WEIGHT
    for phrase, weight in ((row["name"], NAME_WEIGHT), *((alias, ALIAS_WEIGHT) for alias in row["aliases"])):
        yield phrase, weight
        for ending, other in INTERCHANGEABLE_ENDINGS:
            if phrase.endswith(ending):
                yield phrase.removesuffix(ending) + other, min(weight, ALIAS_WEIGHT)
    yield from ((term, TERM_WEIGHT) for term in row["terms"])


def english_nouns(presets: Iterable[Mapping[str, Any]], ours: Mapping[str, Any], people: Mapping[str, Any]) -> Nouns:
    """All English nouns. The packages' search terms for what is said by hand do not count, nor a few names."""
    said = everyday_nouns(people)
    presets = list(presets)
    by_tags = {
        (row["tags"]["amenity"], row["tags"]["cuisine"]): row["id"]
        for row in presets
        if {"amenity", "cuisine"} == set(row["tags"])
    }
    for more in (food_nouns(ours, by_tags), church_nouns(ours)):
        for phrase, rows in more.items():
            add_meanings(said, phrase, rows)
    by_hand = frozenset(said) | frozenset(people["no_terms"])
    never = frozenset(people["never"])
    neither = never | by_hand
    for row in presets:
        for phrase, weight in preset_nouns(row):
            if phrase not in (never if weight > TERM_WEIGHT else neither):
                add_meanings(said, phrase.casefold(), {row["id"]: weight})
    return sort_by_weight(said)


def foreign_nouns(ids: Iterable[str], names: Iterable[str], is_wanted: Callable[[str], bool]) -> Nouns:
    """The nouns of a language that are wanted: by kind its names, and after a tab its aliases, one a line."""
    said: Weights = {}
    for key, row in zip(ids, names, strict=True):
        first, _, more = row.partition("\t")
        for phrases, weight in ((first, NAME_WEIGHT), (more, ALIAS_WEIGHT)):
            for phrase in filter(is_wanted, phrases.casefold().split("\n")):
                add_meanings(said, phrase, {key: weight})
    return sort_by_weight(said)


def sort_by_weight(said: Weights) -> Nouns:
    """The nouns with what is meant most plainly first."""
    return {phrase: tuple(sorted(rows.items(), key=lambda row: (-row[1], row[0]))) for phrase, rows in said.items()}
