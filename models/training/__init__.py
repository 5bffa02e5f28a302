"""Everything that makes weights: training data, the loop in `engine/`, and a `fit_*` module for each model."""
