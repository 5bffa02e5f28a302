"""The nouns for kinds, from the packages and the hand-written files."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any

from models.citymap.kinds.matching import Kind

NAME_WEIGHT, ALIAS_WEIGHT, TAG_WEIGHT, LOOSE_WEIGHT, TERM_WEIGHT = 1.0, 0.9, 0.8, 0.7, 0.5
Weights = dict[str, dict[str, float]]
Nouns = dict[str, tuple[tuple[str, float], ...]]
# Phrases made from the tag of a kind, by the first part of its id.
TAG_PHRASES = {
    "shop": ("{} shop", "{} store"),
    "office": ("{} office",),
    "building": ("{} building",),
    "historic": ("historic {}",),
    **dict.fromkeys(("amenity", "leisure", "man_made", "natural", "tourism", "barrier", "craft"), ("{}",)),
}
# Phrases for places by nationality of their food, and by dish; weights of the cuisine and of the restaurant.
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
# Endings that are used for each other.
INTERCHANGEABLE_ENDINGS = ((" store", " shop"), (" shop", " store"), (" center", " centre"), (" parlor", " parlour"))


def additional_kinds(tables: Mapping[str, Any], taken: Iterable[Kind]) -> Iterator[Kind]:
    """Yield the kinds that the packages lack: listed ones, cuisines and their restaurants, church denominations."""
    taken_tags = [kind.tags for kind in taken]
    kinds = [Kind(key, row["name"], row["tags"]) for key, row in tables["kinds"].items()]
    for values, words in {**tables["nations"], **tables["dishes"]}.items():
        kinds += [Kind(f"cuisine/{value}", f"{words[0]} food", {"cuisine": value}) for value in values.split("|")]
    for values, words in tables["nations"].items():
        for value in values.split("|"):
            tags = {"amenity": "restaurant", "cuisine": value}
            kinds.append(Kind(f"amenity/restaurant/{value}", f"{words[0]} restaurant", tags))
    for values, words in tables["denominations"].items():
        for value in values.split("|"):
            tags = {"amenity": "place_of_worship", "religion": "christian", "denomination": value}
            kinds.append(Kind(f"amenity/place_of_worship/christian/{value}", f"{words[0]} church", tags))
    return (kind for kind in kinds if kind.tags not in taken_tags)


def everyday_nouns(people: Mapping[str, Any]) -> Weights:
    """Return the words of people.toml: "phrase, phrase" = "kind kind~ kind~0.6 @group"; ~ marks a loose meaning."""
    nouns: Weights = {}
    for phrases, kinds in people["words"].items():
        rows: dict[str, float] = {}
        for one in kinds.split():
            key, loose, weight = one.partition("~")
            for member in people["groups"][key[1:]] if key.startswith("@") else [key]:
                rows[member] = max(rows.get(member, 0), float(weight or LOOSE_WEIGHT) if loose else NAME_WEIGHT)
        for phrase in phrases.split(","):
            add_meanings(nouns, phrase.strip().casefold(), rows)
    return nouns


def add_meanings(nouns: Weights, phrase: str, rows: Mapping[str, float]) -> None:
    """Add kinds as meanings of a phrase; the higher weight counts."""
    kinds = nouns.setdefault(phrase, {})
    for key, weight in rows.items():
        if weight > kinds.get(key, 0):
            kinds[key] = weight


def food_nouns(tables: Mapping[str, Any], by_tags: Mapping[tuple[str, str], str]) -> Weights:
    """Return the nouns for places by their food: "thai place", "pizza joint"."""
    nouns: Weights = {}
    for part, phrases in (("nations", NATION_PHRASES), ("dishes", DISH_PHRASES)):
        for values, words in tables[part].items():
            for value in values.split("|"):
                restaurant = by_tags.get(("restaurant", value), "")
                for word in words:
                    for phrase, weights in phrases.items():
                        pairs = zip((f"cuisine/{value}", restaurant), weights, strict=True)
                        add_meanings(
                            nouns, phrase.format(word), {key: weight for key, weight in pairs if key and weight}
                        )
    return nouns


def church_nouns(tables: Mapping[str, Any]) -> Weights:
    """Return the nouns for churches by their denomination."""
    nouns: Weights = {}
    for values, words in tables["denominations"].items():
        for key in (f"amenity/place_of_worship/christian/{value}" for value in values.split("|")):
            for word in words:
                add_meanings(nouns, f"{word} church", {key: NAME_WEIGHT})
                add_meanings(nouns, f"{word} parish", {key: TAG_WEIGHT})
    return nouns


def preset_nouns(row: Mapping[str, Any]) -> Iterator[tuple[str, float]]:
    """Yield the English nouns for a preset."""
    first, _, rest = row["id"].partition("/")
    if rest and "/" not in rest and list(row["tags"].items()) == [(first, rest)]:
        for phrase_form in TAG_PHRASES.get(first, ()):
            yield phrase_form.format(rest.replace("_", " ")), TAG_WEIGHT
    for phrase, weight in ((row["name"], NAME_WEIGHT), *((alias, ALIAS_WEIGHT) for alias in row["aliases"])):
        yield phrase, weight
        for ending, replacement in INTERCHANGEABLE_ENDINGS:
            if phrase.endswith(ending):
                yield phrase.removesuffix(ending) + replacement, min(weight, ALIAS_WEIGHT)
    yield from ((term, TERM_WEIGHT) for term in row["terms"])


def english_nouns(presets: Iterable[Mapping[str, Any]], tables: Mapping[str, Any], people: Mapping[str, Any]) -> Nouns:
    """Return all English nouns; hand-written meanings replace the packages' search terms and some of their names."""
    nouns = everyday_nouns(people)
    presets = list(presets)
    by_tags = {
        (row["tags"]["amenity"], row["tags"]["cuisine"]): row["id"]
        for row in presets
        if {"amenity", "cuisine"} == set(row["tags"])
    }
    for more in (food_nouns(tables, by_tags), church_nouns(tables)):
        for phrase, rows in more.items():
            add_meanings(nouns, phrase, rows)
    by_hand = frozenset(nouns) | frozenset(people["no_terms"])
    excluded = frozenset(people["never"])
    excluded_terms = excluded | by_hand
    for row in presets:
        for phrase, weight in preset_nouns(row):
            if phrase not in (excluded if weight > TERM_WEIGHT else excluded_terms):
                add_meanings(nouns, phrase.casefold(), {row["id"]: weight})
    return sort_by_weight(nouns)


def foreign_nouns(ids: Iterable[str], names: Iterable[str], is_wanted: Callable[[str], bool]) -> Nouns:
    """Return the wanted nouns of a language: for each kind its names, and after a tab its aliases, one a line."""
    nouns: Weights = {}
    for key, row in zip(ids, names, strict=True):
        first, _, more = row.partition("\t")
        for phrases, weight in ((first, NAME_WEIGHT), (more, ALIAS_WEIGHT)):
            for phrase in filter(is_wanted, phrases.casefold().split("\n")):
                add_meanings(nouns, phrase, {key: weight})
    return sort_by_weight(nouns)


def sort_by_weight(nouns: Weights) -> Nouns:
    """Return the nouns with the kinds of the highest weight first."""
    return {phrase: tuple(sorted(rows.items(), key=lambda row: (-row[1], row[0]))) for phrase, rows in nouns.items()}
