"""The hint posterior: where a description was said, over positions of a map (docs/method.md, the hint posterior).

`binding` puts what was read into a map's words, `likelihood` says how likely it is at a node (`node_batch`),
`posterior` and `locate` make a distribution of it; `surroundings/` is what lies around every node, `model` all that is
learned. May import models.citymap and language, and `Located` of localization; not retrieval: candidates from
vectors are handed in.
"""
