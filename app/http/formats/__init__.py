"""Other formats of an answer: GeoJSON, Nominatim's JSON, PIDF-LO, and the negotiation between them."""
