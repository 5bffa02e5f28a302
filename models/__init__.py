"""Maps, language, the paper's models, the posterior and their training; maps/ and weights/ are data that ship.

Imports nothing of index and app.
"""
