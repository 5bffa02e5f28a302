"""Training: what is fitted, and on what (docs/method.md).

A `fit_*` a thing that is fitted: retriever, points, fine stage, reader, likelihood, posterior. `training_data`,
`retrieval_data`, `fine_data` and `places` make examples, `validation` and `metrics` measure, `settings` and configs/
say how, `experiments` are the paper's tables; engine/ is the loop. May import all of models; nothing that answers
imports it.
"""
