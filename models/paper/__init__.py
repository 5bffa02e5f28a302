"""The coarse stage: descriptions and cells as vectors of one space (docs/method.md, MNCL, losses, baselines).

`retriever` is what all are; a file a method: `mncl`, `text2loc`, `ret`, `text2pos`. `instance_encoder`,
`point_encoder`, `scene_graph` and `layers` are their parts; `levels` and `level_table` compare, `losses` train them,
`checkpoint` keeps them. May import models.citymap and language.
"""
