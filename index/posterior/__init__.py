"""Answers by the hint posterior.

`localizer` reads descriptions, binds them to the map, locates and explains; `place_reader` finds the places that a text
names, and `meaning` which kind strange words mean. May import index, its asking and words, and what models serves.
"""
