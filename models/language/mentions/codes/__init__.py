"""Codes in a text: coordinates, links of maps, plus codes, references of stops, exits and roads, postcodes."""
