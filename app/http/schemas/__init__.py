"""Requests and responses of the service as pydantic models, the fields they share, and examples."""
