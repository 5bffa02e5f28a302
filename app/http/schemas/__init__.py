"""What the service reads and writes, as pydantic models: requests, responses, the fields they share, examples.

May import app.http's error and query types, app.settings, and of index and models the types of answers.
"""
