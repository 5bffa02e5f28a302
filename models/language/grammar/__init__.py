"""The paraphrase grammar that trains and tests the reader: phrases in TOML files, and a writer of labelled texts.

`files` loads a grammar without the phrases of the others, `wording` and `passages` write texts (`labelled_text`), and
`typos` adds typing errors. May import models.language and models.citymap.
"""
