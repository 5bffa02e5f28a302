"""Other forms of an answer: GeoJSON, Nominatim's, and which form a client gets.

May import app.http, its schemas, and of index and models the types of answers.
"""
