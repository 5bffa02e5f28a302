"""OpenStreetMap as a city map: `map` reads elements by classes.toml, `feature_strips` and `imported_map` import them.

`gazetteer` reads named objects, `extract` takes a region of a file, `city_copies` makes a large city of copies, whose
streets `copy_names` renames. `places` lists named areas, `summary` says what a file is good for. May import
models.citymap, its gazetteer and kinds.
"""

import os

# By default osmium decodes some 200 MB of blocks ahead; three blocks are as fast.
for _queue in ("INPUT", "OSMDATA"):
    os.environ.setdefault(f"OSMIUM_MAX_{_queue}_QUEUE_SIZE", "3")
