"""From text to hints and mentions: the text encoder, the hint reader, and `mentions/`, which reads names and places."""
