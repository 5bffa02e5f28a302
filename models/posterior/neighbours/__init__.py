"""The neighbours of every node of a map: class, colour, distance and bearing of the nearest objects."""
