"""From models to answers: build an index, open it, localize. No HTTP here.

`offline/` is the job that makes an index, `artifact` its directory, `remote/` one that is elsewhere, `stores/`,
`ranking` and `hint_features` what is in it; `localizer` answers queries (`answers`, `filters`) by the hint posterior
(`posterior/`, which asks back by `asking/` and names places by `words/`) or by vectors and a fine stage
(`vector_localizer`), and `finding` makes the answer of what either found; `picture` draws it. May import models, but
nothing that trains, and nothing that measures. FAISS is at home here.
"""
