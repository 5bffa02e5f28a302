"""Names and kinds of places in a text: streets, corners, shops, and where the speaker says they are.

`reader` is what others use. `names` and `streets` put words into one form, `lookup` finds a map's objects by them,
`spans` the words of a text that name something, `meaning` what paraphrases it, `crossings` corners and addresses,
`cues` where a thing is from the speaker, `mentions` puts that together; `words` has the words of English, `languages`
tells other ones. May import models.citymap, its gazetteer and its kinds; knows nothing of positions.
"""
