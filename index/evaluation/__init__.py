"""Measuring: predictions, scores, reports, simulated people, and the reproduction of the paper's tables."""
