"""What a passer-by could name on a map: shops, stops, streets, corners, house numbers, each with its geometry.

`gazetteer` is the table, `ways` the way from positions to its objects, `raster` about how far they are, `streets` joins
what is one street. Sources fill it (`models.sources.osm.gazetteer`). May import models.citymap alone.
"""
