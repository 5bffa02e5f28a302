"""Requests and responses of the service as pydantic models, the fields they share, and examples.

May import app.http's error and query types, app.settings, and of index and models the types of answers.
"""
