"""A made-up gazetteer for tests: three streets, three avenues, things along them, and a road that meets none."""

import numpy as np

from models.citymap.gazetteer.gazetteer import ADDRESS_KIND, Gazetteer, build_gazetteer
from models.citymap.gazetteer.name_columns import STREET_KIND, GazetteerObject

EAST_WEST = {"West 24th Street": 0.0, "West 25th Street": 80.0, "West 26th Street": 160.0}
NORTH_SOUTH = {"11th Avenue": 0.0, "10th Avenue": 200.0, "9th Avenue": 400.0}
HARLEM_ROAD_Y = 420.0
PARK = (240.0, 10.0, 330.0, 70.0)  # low x, low y, high x, high y
MARKET = (300.0, 90.0, 340.0, 130.0)
POINTS: dict[str, tuple[tuple[float, float], tuple[str, ...]]] = {
    "Bottino": ((215.0, 92.0), ("amenity/restaurant",)),
    "Café Zoë": ((388.0, 92.0), ("amenity/cafe",)),
    "Joe's Coffee": ((20.0, -12.0), ("amenity/cafe",)),
    "T-Optik": ((120.0, 92.0), ("shop/optician", "shop")),
    "Elmo": ((120.0, 148.0), ("amenity/restaurant",)),
    "Кафе Пушкин": ((60.0, 92.0), ("amenity/restaurant",)),
    "北京饭店": ((60.0, 68.0), ("amenity/restaurant",)),
    "London Terrace Gardens": ((300.0, 148.0), ("building",)),
    "Rossi Bakery": ((60.0, 172.0), ("shop/bakery", "shop")),
    "Duane Reade": ((412.0, 172.0), ("amenity/pharmacy",)),
}
NUMBERS = {"402": (390.0, 95.0), "410": (350.0, 95.0), "450": (250.0, 95.0), "401": (390.0, 65.0), "449": (250.0, 65.0)}
BENCHES = tuple((x, y) for x in np.arange(0.0, 401.0, 25.0) for y in (10.0, 90.0, 170.0))


def ring(low_x: float, low_y: float, high_x: float, high_y: float) -> np.ndarray:
    """[4, 4] the segments of a box."""
    corners = np.array([(low_x, low_y), (high_x, low_y), (high_x, high_y), (low_x, high_y)])
    return np.concatenate([corners, np.roll(corners, -1, axis=0)], axis=1)


def point(x: float, y: float) -> np.ndarray:
    """[1, 4] a segment without length."""
    return np.array([[x, y, x, y]])


def line(*xy: tuple[float, float]) -> np.ndarray:
    """[n, 4] a line through points."""
    position = np.array(xy, dtype=float)
    return np.concatenate([position[:-1], position[1:]], axis=1)


def made_gazetteer() -> Gazetteer:
    """The town."""
    words, segments, is_area = [], [], []

    def add(part: GazetteerObject, shape: np.ndarray, area: bool = False) -> int:
        words.append(part)
        segments.append(shape)
        is_area.append(area)
        return len(words) - 1

    for name, (position, kinds) in POINTS.items():
        add(GazetteerObject(kinds, (name,)), point(*position))
    add(GazetteerObject(("leisure/park",), ("Chelsea Park",)), ring(*PARK), True)
    add(GazetteerObject(("shop/supermarket", "shop"), ("Whole Foods Market", "Whole Foods")), ring(*MARKET), True)
    for number, position in NUMBERS.items():
        add(GazetteerObject((ADDRESS_KIND,), (), number, "West 25th Street"), point(*position))
    for position in BENCHES:
        add(GazetteerObject(("amenity/bench",)), point(*position))
    rows = {
        name: add(GazetteerObject((STREET_KIND,), (name,)), line((-50, y), (450, y))) for name, y in EAST_WEST.items()
    }
    columns = {
        name: add(GazetteerObject((STREET_KIND,), (name,)), line((x, -50), (x, 210))) for name, x in NORTH_SOUTH.items()
    }
    add(GazetteerObject((STREET_KIND,), ("Harlem Road",)), line((-50, HARLEM_ROAD_Y), (450, HARLEM_ROAD_Y)))
    pairs = [(row, column) for row in rows.values() for column in columns.values()]
    places = [(x, y) for y in EAST_WEST.values() for x in NORTH_SOUTH.values()]
    corners = (np.array(pairs, dtype=np.int64), np.array(places, dtype=np.float32))
    return build_gazetteer(words, segments, is_area, corners)


def numbered(gazetteer: Gazetteer, name: str) -> int:
    """The object of a name or, without one of that name, of a house number."""
    return next(n for n, words in enumerate(gazetteer.objects) if name in (*words.names, words.number))


def called(gazetteer: Gazetteer, objects: np.ndarray) -> set[str]:
    """Return the names of some objects."""
    chosen = [gazetteer.objects[n] for n in objects]
    return {item.names[0] if item.names else item.number or item.kinds[0] for item in chosen}


# Everyday words, as a tokenizer's commonest are.
COMMON = frozenset(
    [
        "a",
        "an",
        "the",
        "i",
        "im",
        "we",
        "you",
        "he",
        "it",
        "is",
        "are",
        "am",
        "was",
        "my",
        "me",
        "our",
        "your",
        "this",
        "that",
        "there",
        "here",
        "of",
        "and",
        "at",
        "in",
        "on",
        "by",
        "to",
        "from",
        "with",
        "for",
        "off",
        "up",
        "down",
        "over",
        "past",
        "near",
        "next",
        "right",
        "left",
        "ahead",
        "behind",
        "across",
        "between",
        "opposite",
        "outside",
        "inside",
        "front",
        "back",
        "facing",
        "looking",
        "standing",
        "walking",
        "see",
        "can",
        "just",
        "door",
        "doors",
        "block",
        "blocks",
        "few",
        "two",
        "meters",
        "feet",
        "street",
        "avenue",
        "road",
        "park",
        "cafe",
        "shop",
        "store",
        "bench",
        "restaurant",
        "bakery",
        "corner",
        "side",
        "north",
        "south",
        "east",
        "west",
        "meet",
        "hand",
        "straight",
        "head",
        "go",
        "come",
        "hurry",
        "please",
        "market",
        "big",
        "old",
        "red",
        "green",
        "white",
        "black",
        "one",
        "first",
        "second",
        "hello",
        "what",
        "where",
        "road",
        "town",
        "city",
        "house",
        "home",
        "middle",
        "some",
        "things",
        "other",
        "far",
        "so",
        "food",
        "foods",
        "whole",
        "coffee",
        "gardens",
        "terrace",
        "new",
        "waiting",
        "get",
        "got",
        "stop",
        "bus",
        "station",
        "place",
    ]
)


def is_common(word: str) -> bool:
    """Whether a word is an everyday one."""
    return word in COMMON
