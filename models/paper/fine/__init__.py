"""The fine stages: from a description and a candidate cell to a position inside it (docs/method.md, fine stage).

`fine_model` is what all are, `regressor` and `matching` are the methods, `checkpoint` keeps them. May import
models.citymap, language and retrieval, whose encoders they share.
"""
