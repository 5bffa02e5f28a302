"""Cells and poses in columns that open at once (docs/formats.md, converted store).

`files` opens and converts, `columns` writes, `layout` says what the columns are, `pose_store` and `pose_table` are what
training, indexing and evaluation use. May import models.citymap and kitti360pose, which it converts.
"""
