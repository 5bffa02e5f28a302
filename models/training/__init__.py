"""Training: what is fitted, and on what (docs/method.md).

A `fit_*` a thing that is fitted: retriever, points, fine stage; posterior/ what the posterior has. `training_data`,
`retrieval_data` and `fine_data` make examples, `validation` and `metrics` measure, `settings` and configs/ say how,
`experiments` says what a table is and `paper_tables` has the paper's; engine/ is the loop. May import all of models;
nothing that answers imports it.
"""
