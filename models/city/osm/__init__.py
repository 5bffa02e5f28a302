"""OpenStreetMap as a city map: `map` reads elements by classes.toml, `sampling` puts points on their geometry.

`gazetteer` reads what has a name, `extract` takes a part of a file, `tiling` makes a large city of copies, which
`renaming` names. May import models.city, its gazetteer and kinds.
"""
