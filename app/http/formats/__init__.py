"""Other formats of an answer: GeoJSON, Nominatim's JSON, and the negotiation between them.

May import app.http, its schemas and, from index and models, the types of answers.
"""
