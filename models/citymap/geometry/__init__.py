"""A map of lines and areas as pieces: the part of each instance in each tile of 10 m.

Cells, the neighbours of a position and the sampled points of an instance are made from pieces. `tiling` cuts them,
`cutting` cuts cubes, `closest_points` measures from positions. May import models.citymap.
"""
