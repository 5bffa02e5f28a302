"""Language: text to what was said, and what was said to labels.

`text_encoder` is the frozen language model; `reader` finds what a description names (`parsed_hint`), `labels`,
`spelling` compares it with a map's words; `sentences` splits texts. lexicon/ is served with the
weights, grammar/ trains the reader and no more. May import models.citymap.
"""
