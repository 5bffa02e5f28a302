"""Language: text to what was said, and hints to sentences.

`text_encoder` is the frozen language model; `reader` finds what a description names (`parsed_hint`), `labels`,
`landmarks` and `spelling` compare it with a map's words; `hints_text` splits texts and writes hints. grammar/ is what
the reader is trained on. May import models.city.
"""
