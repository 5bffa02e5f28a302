"""A city's own data, which joins a map from OpenStreetMap: points, lines and polygons of one kind per file.

`layer` is the interface; `kinds` reads the kind, `geojson`, `csv_rows` and `overpass` read the files.
May import models.citymap and models.sources.osm.classes.
"""
