"""The hint posterior: how likely a text is at every node of a map, and the position distribution that follows."""
