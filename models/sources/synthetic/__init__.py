"""Synthetic towns as raw KITTI-360 files, so that everything runs without KITTI-360: `towns` writes them.

`layout`, `streets`, `site`, `lots`, `objects`, `shapes` and `styles` build a town, `drive` drives through it. May
import models.citymap, kitti360 (the raw layout) and kitti360pose (names of scenes).
"""
