"""Turn text into hints and mentions: the text encoder, the hint reader, and `mentions/` for names and places."""
