"""Raw KITTI-360 made into KITTI360Pose (docs/formats.md, preparation rules): `raw` reads, `prepare` and `describe` cut.

`rules` has the numbers, `job` prepares scene by scene and resumes, `record` says what a scene was made from.
May import models.citymap and kitti360pose, whose layout it writes.
"""
