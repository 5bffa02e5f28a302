"""OpenStreetMap as a city map: `map` reads elements by classes.toml, `strips` and `taking` make instances of them.

`gazetteer` reads what has a name, `extract` takes a part of a file, `tiling` makes a large city of copies, which
`renaming` names. May import models.citymap, its gazetteer and kinds.
"""

import os

# Of a large file osmium has some 200 MB of blocks decoded ahead, unless it is told before it reads; three will do.
for _queue in ("INPUT", "OSMDATA"):
    os.environ.setdefault(f"OSMIUM_MAX_{_queue}_QUEUE_SIZE", "3")
