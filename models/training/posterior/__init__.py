"""What the posterior is fitted to: reader of hints, likelihood, reader of cues, kernels of places (docs/method.md).

`fit_posterior` and `train_places` are the two runs; `places` makes the examples of the first.
May import what models.training may.
"""
