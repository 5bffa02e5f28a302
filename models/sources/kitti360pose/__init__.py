"""KITTI360Pose's published layout (docs/formats.md): its records, read by an allow-list unpickler, checked, written.

`files` is the interface; `pickle_reader`, `pickle_values` and `fields` are below it, `pickle_writer` writes,
`direction` has the cells' neighbours. May import models.citymap.
"""
