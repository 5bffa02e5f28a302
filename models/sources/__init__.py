"""Sources of maps and descriptions, a folder for each; `source.open_source` is the single entry point to data."""
