"""Maps of labelled instances, cut into cells and described by hints. NumPy only, no torch.

`types` defines the nouns. `geometry/` cuts maps of lines and areas, `gazetteer/` holds what has a name or a kind,
`kinds/` says which tags make which kind, `scenery/` is what the page draws.
"""
