"""A position in words.

`place_text` names it as an answer does, `describing` says what is there, by which it is found again. May import index's
answers, and what models serves.
"""
