"""What the world is and what is learned, in NumPy and torch.

city/ (maps, cells, hints), language/ (text to what was said), retrieval/ (the coarse stage), localization/ (the fine
stages), posterior/ (the hint posterior), training/; maps/ and weights/ are data that ship. `errors` are those that a
user can meet, `checkpoint` keeps models on disk. May import nothing of index and app.
"""
