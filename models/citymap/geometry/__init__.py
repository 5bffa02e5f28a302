"""A map of lines and areas as pieces: what of each instance lies in each tile of 10 m.

Cells, what is around a position and what a model sees of an instance come from these, without sampled points. `tiling`
makes them, `cutting` cuts cubes, `ways` measures from positions. May import models.citymap.
"""
