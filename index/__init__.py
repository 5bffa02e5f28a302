"""Everything between the models and HTTP: build an index, open it, localize, evaluate.

`build/` builds an index, `stores/` holds its vectors, `answering/` opens it and answers queries, `asking/` chooses the
follow-up question, `evaluation/` computes metrics and reproduces the paper's tables.
"""
