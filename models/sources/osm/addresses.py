"""House numbers with their streets, and the references of stops, exits, doors and roads, from the tags of elements."""

import re
from pathlib import Path
from typing import Any, Final

import osmium

from models.citymap.gazetteer.name_columns import plain_code

ADDRESS_KEYS: Final = ("addr:street", "addr:place")
QUARTER_KEYS: Final = ("addr:quarter", "addr:hamlet", "addr:suburb")  # of numbers without either
STOP_RAILWAYS: Final = frozenset(("tram_stop", "station", "halt", "stop", "platform"))
EXIT_RAILWAYS: Final = frozenset(("subway_entrance", "train_station_entrance"))
STREET_RELATIONS: Final = frozenset(("associatedStreet", "street"))
MAX_CODE_CHARACTERS: Final = 10  # longer ones are for machines
_ELEMENTS: Final = {"n": "node", "w": "way", "r": "relation"}
_REF_KEY: Final = re.compile(r"ref|local_ref|ref:\w+|gtfs_(?:id|stop_code)|gtfs:stop_(?:id|code)")


def read_streets(path: Path) -> dict[str, str]:
    """Return the street of each house ("node/1") that has it from a relation, as most houses of France."""
    streets = dict[str, str]()
    relations: Any = osmium.FileProcessor(str(path), osmium.osm.RELATION)
    for relation in relations:
        name = relation.tags.get("name")
        if relation.tags.get("type") in STREET_RELATIONS and name:
            houses = (member for member in relation.members if member.role in ("house", "address"))
            streets.update((f"{_ELEMENTS[house.type]}/{house.ref}", name) for house in houses)
    return streets


def with_street(tags: dict[str, str], source_id: str, streets: dict[str, str]) -> dict[str, str]:
    """Return tags with the street of a house from `read_streets` if they have none."""
    if "addr:housenumber" not in tags or source_id not in streets or any(key in tags for key in ADDRESS_KEYS):
        return tags
    return {**tags, "addr:street": streets[source_id]}


def read_address(tags: dict[str, str]) -> tuple[str | None, str | None]:
    """Return the house number, and the street, place or quarter that it is of."""
    number = tags.get("addr:housenumber") or tags.get("addr:conscriptionnumber")
    street = next((tags[key] for key in (*ADDRESS_KEYS, *QUARTER_KEYS) if key in tags), None)
    if number and "addr:block_number" in tags and "-" not in number:  # of Japan: 3丁目, block 10, house 3 is 3-10-3
        parts = tags.get("addr:neighbourhood", "").removesuffix("丁目"), tags["addr:block_number"], number
        number = "-".join(part for part in parts if part)
    return number, street


def read_codes(tags: dict[str, str]) -> tuple[str, ...]:
    """Return the references of a stop, an exit, a door or a road, and the postcode of an address."""
    ref = [tags["ref"]] if "ref" in tags else []
    codes = [("post", tags["addr:postcode"])] if "addr:postcode" in tags else []
    if (
        tags.get("highway") in ("bus_stop", "platform")
        or tags.get("railway") in STOP_RAILWAYS
        or "public_transport" in tags
    ):
        codes += [("stop", tags[key]) for key in tags if _REF_KEY.fullmatch(key)]
    elif tags.get("railway") in EXIT_RAILWAYS:
        codes += [("exit", one) for one in ref]
    elif "entrance" in tags or "highway" in tags:
        codes += [("door" if "entrance" in tags else "road", one) for one in ref]
    plain = ((kind, plain_code(part)) for kind, code in codes for part in code.split(";"))
    return tuple(dict.fromkeys(f"{kind} {code}" for kind, code in plain if 0 < len(code) <= MAX_CODE_CHARACTERS))
