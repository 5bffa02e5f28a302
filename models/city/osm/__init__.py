"""OpenStreetMap as a city map: `map` reads elements by classes.toml, `sampling` puts points on their geometry.

May import models.city.
"""
