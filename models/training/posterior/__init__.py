"""Training of the posterior: hint reader, likelihood, cue reader and place kernels (docs/method.md, fitting).

`fit_posterior` and `train_places` are the two runs; `training_sites` makes the examples of the first.
May import what models.training may.
"""
