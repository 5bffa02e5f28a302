"""Values that no operation takes, by operation and field; MARK, DIGITS and FRACTION stand in many, to be looked for."""

import json
from typing import Any

Table = dict[str, dict[str, list[Any]]]
MARK, DIGITS, FRACTION = "zq7secret", "98765432109876543210", 98.7654321
HUGE = int(DIGITS * 20)  # no float is as large
SCRIPT = "<script>alert(1)</script>"

NAMES = [
    *("", " ", ".", "..", "../x", f"../{MARK}", "/etc/passwd", f"a/{MARK}", f"a\\{MARK}", f"{MARK}\n", f"{MARK}\0"),
    *(f"{MARK} b", f"ä{MARK}", SCRIPT, f"-{MARK}", f".{MARK}", f"%2e%2e%2f{MARK}", MARK * 20),
]
NO_TEXT = [5, True, 1.5, [MARK], {MARK: MARK}]
NO_NAME = [*NAMES, *NO_TEXT, None]
TEXTS = [
    *("", " \n\t ", "?!.", "\u200b", f"{MARK}\0", f"{MARK}\x07", f"{MARK}\x1b[31m", f"{MARK}\x85", f"{MARK}\ud800"),
    *(f"\udfff{MARK}", MARK * 500, f"{MARK}. " * 201, f"{SCRIPT}. " * 201),
]
NO_NUMBER = [True, False, "5", MARK, [1], {"a": 1}, "NaN", "0x10"]
NO_INTEGER = [*NO_NUMBER, None, 0, -1, 5.0, 1.5, int(DIGITS), -int(DIGITS), HUGE, 1e300]
NO_LENGTH = [*NO_NUMBER, None, 0, -1, -0.0, 1e-200, 1e9, HUGE]
NO_POINT = [
    *(None, 5, "0,0", MARK, {}, {"x": 0, "y": 0}, [], [0], [0, 0, 0], [0, None], [0, MARK], [[0], 0], [0, "1"]),
    *([True, 0], [0, 1e9], [-1e9, 0], [0, HUGE], [int(DIGITS), 0]),
]
NO_FLAG = [None, 0, 1, "true", MARK, [True]]
NO_CRS = ["", " ", MARK, "MAP", "utm", "map ", "map\0", None, 5, True, ["map"]]
NO_REFINE = ["", MARK, "Posterior", "posterior ", None, 5, True, ["none"]]
NOT_ON_EARTH = [[181, 0], [-180.1, 0], [0, 90.1], [0, -91], [60.17, 124.9], [115, 0], [1e8, 1e8]]
CROSSED = [[0, 0], [FRACTION, FRACTION], [FRACTION, 0], [0, FRACTION], [0, 0]]
CIRCLE = {"center": [0, 0], "radius_m": 5}
TREE = {"question": "near:tree", "choice": "yes"}
ODD = f"{MARK}!"  # as the name of a field; one of plain letters may be said again

BASES = {  # what else stands in a bad body
    "POST /localize": {"description": f"a tree {MARK}"},
    "POST /describe": {"position": [FRACTION, 0]},
    "POST /corrections": {"request": {"description": f"a tree {MARK}"}, "position": [FRACTION, 0]},
    "POST /evaluate": {"queries": [{"description": f"a tree {MARK}", "position": [FRACTION, 0]}]},
}
WITHIN = [
    *({}, [], 5, MARK, {ODD: 1}, {"bbox": None}, {"circle": None}, {"bbox": [0, 0, 1, 1], "circle": CIRCLE}),
    *({"bbox": box} for box in ([], [0, 0, 1], [0, 0, 1, 1, 1], [1, 0, 0, 1], [0, 1, 1, 0], [0, 0, 1, MARK])),
    *({"bbox": box} for box in ([0, 0, 1, True], [0, 0, 1, None], [0, 0, 1, 1e9], "0,0,1,1", [[0, 0], [1, 1]])),
    *({"circle": circle} for circle in ([], [0, 0, 5], MARK, {"center": [0, 0]}, {"radius_m": 5}, CIRCLE | {ODD: 1})),
    *({"type": "Polygon", "coordinates": value} for value in (*NO_POINT, [[[FRACTION, MARK]]], [[[FRACTION, 0]] * 4])),
    *({"type": MARK, "coordinates": []}, {"type": "Polygon", ODD: 1}, {"type": "Polygon", "coordinates": [CROSSED]}),
    *({"circle": CIRCLE | {"center": point}} for point in NO_POINT[::3]),
    *({"circle": CIRCLE | {"radius_m": radius}} for radius in NO_LENGTH[::2]),
]
PRIOR = [
    *([], 5, MARK, {}, {"position": [0, 0]}, {"sigma_m": 5}, {"position": [0, 0], "sigma_m": 5, ODD: 1}),
    *({"position": point, "sigma_m": 5} for point in NO_POINT[1::3]),
    *({"position": [0, 0], "radius_m": radius, "confidence": 0.9} for radius in NO_LENGTH),
    *({"position": [0, 0], "radius_m": 5, "confidence": value} for value in (*NO_NUMBER, 0, 1, 68, -1, 1e300)),
    *({"position": [0, 0], "semi_major_m": 5, "semi_minor_m": value, "orientation_deg": 0} for value in NO_LENGTH),
    *({"position": [0, 0], "semi_major_m": 5, "semi_minor_m": 2, "orientation_deg": value} for value in NO_NUMBER),
    *({"position": [FRACTION, 0], "sigma_m": sigma} for sigma in NO_LENGTH[1::2]),
]
ANSWERS = [
    *(None, MARK, {}, [MARK], [5], [{}], [{"question": MARK}], [{"choice": MARK}], [TREE] * 9, [TREE, TREE]),
    *([TREE, TREE | {"choice": MARK}], [TREE | {ODD: 1}]),
    *([TREE | {"question": value}] for value in (*NO_TEXT, None, "", MARK * 200)),
    *([TREE | {"choice": value}] for value in (*NO_TEXT[::2], None, "", MARK * 200)),
]
FIELDS: Table = {  # in place of what a field of BASES has, or beside it
    "POST /localize": {
        "description": [None, *NO_TEXT, *TEXTS],
        "hints": [[MARK], []],
        "within": WITHIN,
        "prior": PRIOR,
        "answers": ANSWERS,
        "top_k": [*NO_INTEGER, 41],
        "deadline_ms": [*NO_INTEGER[1::3], 60_001],
        "crs": NO_CRS,
        "refine": NO_REFINE,
        "heat_map": NO_FLAG,
        "ros": NO_FLAG[::2],
        "index": NO_NAME[1::3],
    },
    "POST /localize/batch": {
        "items": [None, [], {}, MARK, 5, [{"description": MARK}] * 65],
        "index": ["default"],
        "top_k": [1],
    },
    "POST /describe": {
        "position": [*NO_POINT, [0, 1e7]],
        "crs": NO_CRS[::3],
        "deadline_ms": NO_INTEGER[2::3],
        "index": NO_NAME[2::6],
    },
    "POST /corrections": {
        "request": [None, MARK, {}, [], {"description": "?"}, {"description": MARK, ODD: 1}],
        "position": [*NO_POINT[1::3], [0, 1e7]],
        "crs": NO_CRS[2::3],
        "place_rank": [*(value for value in NO_INTEGER[::2] if value is not None), 6],
    },
    "POST /evaluate": {
        "queries": [
            *(None, [], {}, MARK, 5, [MARK], [{}], [{"position": [FRACTION, 0]}], [{"description": MARK}]),
            *([{"description": text, "position": [0, 0]}] for text in (*NO_TEXT, *TEXTS)[::2]),
            *([{"description": MARK, "position": point}] for point in NO_POINT[1::3]),
            [{"description": MARK, "hints": [MARK], "position": [0, 0]}],
            [{"description": MARK, "position": [0, 0], ODD: 1}],
            [{"hints": ["a"], "position": [0, 0]}] * 10_001,
        ],
        "data": [MARK, "/etc/passwd"],
        "split": ["test"],
        "crs": NO_CRS[1::3],
        "grow": [[], MARK, 5, {}, [MARK], [0], [-1], [True], [None], list(range(1, 10)), [1e9]],
        "refine": NO_REFINE[::2],
        "index": NO_NAME[5::6],
    },
}
WHOLE: dict[str, list[Any]] = {  # bodies that are no good as a whole
    "POST /localize": [
        *({"hints": value} for value in (None, MARK, {}, [5], [None], [[MARK]], [MARK, True], [MARK] * 33)),
        *({"hints": [MARK, text]} for text in TEXTS[::3]),
        *({"hints": [MARK * 240, MARK * 240]}, {"hints": ["1. "]}),
        *(
            {"description": MARK, "crs": "wgs84", "prior": {"position": position, "sigma_m": 5}}
            for position in NOT_ON_EARTH
        ),
        *(
            {"description": MARK, "crs": "wgs84", "within": {"circle": CIRCLE | {"center": position}}}
            for position in NOT_ON_EARTH[::3]
        ),
        *({"description": MARK, "crs": "wgs84", "within": {"bbox": box}} for box in ([0, 0, 200, 1], [0, -91, 1, 1])),
        *({"description": MARK, "answers": [TREE], "refine": refine} for refine in ("none", "matching", "regressor")),
        b'{"description": "zq7secret", "prior": {"position": [0, 1e999], "sigma_m": 5}}',
        *({f"x{n}".ljust(length, "y"): 1 for n in range(20)} for length in (1, 20, 64, 200)),
    ],
    "POST /describe": [
        *({"position": position, "crs": "wgs84"} for position in (*NOT_ON_EARTH, [30, 60])),
        b'{"position": [-1e999, 98.7654321]}',
    ],
    "POST /evaluate": [
        *(
            {"queries": [{"description": MARK, "position": position}], "crs": "wgs84"}
            for position in NOT_ON_EARTH[1::3]
        ),
        *({"data": value} for value in (*NO_TEXT, "", *NAMES[3:8], "town.osm\0", "town/../town")),
        *({"data": "town", "split": value} for value in (*NO_TEXT, "", "../x", ODD, "test test", "test\n")),
        *({"data": "town", "crs": "map"}, {"queries": [{}] * 100}),
    ],
}
NO_OBJECT = [None, [], [MARK], MARK, 5, True, 1e300]
UNKNOWN = [ODD, f"{MARK} " * 20, MARK * 20, SCRIPT, "../etc/passwd", "\ud800", f"{MARK}\0", "ä", ""]
RAW = [  # no JSON, or some that is read in two ways
    *(b"", b'{"zq7secret', b"description=zq7secret", b'{"a": "zq7secret"} {}', b'{"a": "zq7secret",}'),
    *(b'{/* zq7secret */ "a": 1}', b"{'a': 'zq7secret'}", b'{"a": "zq7secret\x00"}', b'{"a": 01}', b'{"a": +1}'),
    *(b'{"zq7secret": "\xff\xfe"}', b'{"a": "\xed\xa0\x80"}', '{"ä": 1}'.encode("latin-1")),
    *(json.dumps({"a": MARK}).encode(code) for code in ("utf-16", "utf-32")),
    *(b'{"a": NaN}', b'{"a": [-Infinity]}', b'{"a": 1, "a": "zq7secret"}', b'{"a": [{"b": 1, "b": 2}]}'),
    *(b'{"a": ' + DIGITS.encode() * 300 + b"}", b'{"a": ' + b"[" * 40 + b"]" * 40 + b"}", b"[" * 20_000),
    b'{"a":' * 10_000 + b"1" + b"}" * 10_000,
]
CONTENT_TYPES = [
    *("", "text/plain", "application/x-www-form-urlencoded", "multipart/form-data; boundary=x", "application/jsonx"),
    *("application/geo+json", "application/json; charset=latin-1", 'application/json; charset="utf-16"'),
    *("application/json; charset=", "application/json; charset=utf-8; charset=latin-1", "application/json, text/plain"),
    *("application/json; charset*=latin-1''x", b"application/json; charset=\xff", f"application/{MARK}", "json"),
]
CODINGS = ["gzip", "br", MARK, "identity, gzip"]
ACCEPTS = ["text/html", f"image/{MARK}", MARK, "application/json;q=0", "*/*;q=0", "*/json"]
KEYS = [{"X-API-Key": f"{MARK}-key"}, {"X-API-Key": b"\xff\xfe"}, {"Authorization": f"Bearer {MARK}"}]

NO_DIGITS = [MARK, "1.5", "1e9", "0x10", "true", "nan", DIGITS * 300, "1\0", SCRIPT]
NO_QUERY_INTEGER = ["", "-1", "٣", DIGITS, *NO_DIGITS]
NO_DEGREES = [MARK, "nan", "inf", "-inf", "1e999", "181", "-181", "60,17", "60°", "true", "[0]", DIGITS, "1\0"]
NO_FORMAT = ["html", "JSON", f"json{MARK}", "json\0", SCRIPT]
NO_BOX = [
    *(MARK, "1,2,3", "1,2,3,4,5", "a,b,c,d", "1;2;3;4", "nan,nan,nan,nan", "inf,0,0,0", "0,0,500,500", "0,0,0,91"),
    *("1e300,1e300,-1e300,1e300", ",,,", f"{DIGITS},0,1,1"),
]
QUERIES: Table = {
    "GET /search": {
        "q": [MARK * 500, f"{MARK}. " * 201],
        "street": [MARK * 40],
        "format": NO_FORMAT,
        "limit": NO_DIGITS,
        "viewbox": NO_BOX,
        "bounded": ["maybe", "2", MARK, "1.0", "null"],
        "index": NAMES[1::4],
    },
    "GET /reverse": {
        "lat": [*NO_DEGREES, "90.1"],
        "lon": NO_DEGREES[::2],
        "format": NO_FORMAT[::2],
        "index": NAMES[4::4],
    },
    "GET /lookup": {"osm_ids": [",".join(f"{MARK}{n}" for n in range(51))], "format": NO_FORMAT[1::2]},
    "GET /status": {"format": NO_FORMAT, "index": NAMES[3::4]},
    "GET /cells": {
        "offset": [*NO_QUERY_INTEGER, "1000000001"],
        "limit": [*NO_QUERY_INTEGER[::3], "0", "1001"],
        "index": NAMES[2::4],
    },
    "GET /cells/{cell_id}": {"index": NAMES[3::4]},
    "GET /maps/{name}": {"index": NAMES[1::4]},
    "GET /maps/{name}/points": {"part": [*NO_QUERY_INTEGER[1::2], "1000001"], "index": NAMES[::4]},
}
IDS = [MARK, SCRIPT, "\0", f"ä{MARK}", MARK * 500, "' OR 1=1 --", "../../etc/passwd", "*"]
