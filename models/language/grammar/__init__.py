"""Wordings that the reader is trained and tested on: data in TOML files, and what makes labelled texts of them.

`files` reads a grammar without what another must not share with it, `wording` and `passages` write texts
(`labelled_text`), `typos` spoils them. May import models.language and models.citymap.
"""
