"""From a description and a candidate cell to a position inside it."""
