"""The city model: maps of labelled instances, cut into cells and described in hints. NumPy only, no torch.

`types` are the nouns; `points`, `point_sample`, `cells`, `hints`, `templates`, `colours`, `regions` and `frame` work
on them, `processes` shares work. `source` is the one door to data: a `gallery` of cells, and `queries` about it. A
folder a source: osm/, kitti360/, kitti360pose/, synthetic/; store/ opens at once. May import the errors and files of
models and nothing else of it; its modules know no source, but for the one door to data.
"""
