"""Training: data, the loop, metrics."""
