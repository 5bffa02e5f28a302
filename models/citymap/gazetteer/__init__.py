"""The objects that a passer-by could name: shops, stops, streets, corners, house numbers, each with its geometry.

`gazetteer` is the table, `closest_points` gives exact offsets to its objects, `distance_raster` approximate distances,
`streets` joins the pieces of a street. Sources fill it (`models.sources.osm.gazetteer`). May import models.citymap.
"""
