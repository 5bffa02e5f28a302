"""Maps of labelled instances, cut into cells and described by hints. NumPy only, no torch.

`types` defines the basic types. `geometry/` cuts maps of lines and areas, `gazetteer/` holds named and typed objects,
`kinds/` maps tags to kinds, `scenery/` is the map as the page draws it.
"""
