"""The papers' tables and figures.

`reproduce` trains and measures what is missing, a process for each of `jobs`; `report`, `plots` and `figure_3` write
what was found. May import index, its evaluation and all of models; nothing that answers imports it.
"""
