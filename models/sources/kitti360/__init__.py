"""Raw KITTI-360 made into KITTI360Pose (docs/formats.md, preparation rules): `raw` reads, `prepare` and `describe` cut.

`rules` are the numbers, `job` runs scene by scene and goes on after a break, `record` says what a scene was made from.
May import models.citymap and kitti360pose, whose layout it writes.
"""
