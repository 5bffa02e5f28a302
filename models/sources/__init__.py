"""Where maps and descriptions come from: a folder for each source.

`source.open_source` is the one door to data, for indexing, training and evaluation alike.
"""
