"""Where maps and descriptions come from; `source.open_source` is the one door to data."""
