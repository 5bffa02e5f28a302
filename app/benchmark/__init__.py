"""Benchmarks of speed and size on this machine.

`service` measures one map and one index. `growth` measures cities of several sizes with the queries of `questions`, the
vector stores of `searches` and the charts of `plots`. `processes` starts and measures processes.
"""
