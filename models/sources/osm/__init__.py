"""OpenStreetMap as a city map: `map` builds it, through `features`, `feature_strips` and `imported_map`.

`elements` reads what has a class, `gazetteer` what can be named, `incomplete` what an extract has cut of both.
`extent` finds where a map is, `reading` and `ordering` open files, `tags` leaves out what is not on the ground,
`summary` counts. `extract` takes a region of a file, or one of its `places`; `city_copies` makes a large city of
copies, whose streets `copy_names` renames. May import models.citymap, its gazetteer and kinds.
"""

import os

# By default osmium decodes some 200 MB of blocks ahead; three blocks are as fast.
for _queue in ("INPUT", "OSMDATA"):
    os.environ.setdefault(f"OSMIUM_MAX_{_queue}_QUEUE_SIZE", "3")
