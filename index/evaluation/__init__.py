"""Measuring: predictions of a model are saved, then scored (`scoring`) and drawn (`report`).

`robustness`, `candidates` and `ambiguity` ask other questions, `questions` and `descriptions` measure what else the
service says. May import index and all of models; nothing that answers imports it.
"""
