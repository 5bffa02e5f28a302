"""From models to answers, without HTTP: build an index, open it, localize, measure.

`build/` makes an index, `stores/` holds its vectors, `answering/` opens it and answers, `asking/` finds the next
question, `evaluation/` measures and makes the paper's tables again.
"""
