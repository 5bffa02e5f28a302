"""Cells and poses in columns that open at once (docs/formats.md, converted store).

`files` opens and converts, `columns` writes, `layout` defines the columns, and training, indexing and evaluation use
`pose_store`. May import models.citymap and kitti360pose, which it converts.
"""
