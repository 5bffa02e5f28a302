"""Reproduction of the papers' tables and figures.

`reproduce` trains and measures what is missing, one process per job of `jobs`; `report` and `figures` write
the results. The serving code does not import this package.
"""
