"""What lies around every position of a map: of a scan a table, of a map of pieces found when it is asked for.

`surroundings` is what the others use. May import models.citymap (of its folders tiled alone).
"""
