"""The coarse stage: descriptions and cells as vectors of one space."""
