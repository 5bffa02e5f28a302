"""The city model: maps of labelled instances, cut into cells and described in hints. NumPy only, no torch."""
