"""From models to answers: build an index, open it, localize. No HTTP here.

`build` is the offline job, `artifact` the directory, `gallery`, `store` and `ranking` what is in it; `localizer`
answers queries (`answers`) by the hint posterior or by vectors and a fine stage; `map_data` is any map with its
queries; `picture` draws an answer. May import models, but nothing that trains, and nothing of index.evaluation. FAISS
is at home here.
"""
