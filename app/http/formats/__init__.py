"""Other formats of an answer: GeoJSON, Nominatim's JSON, and the negotiation between them."""
