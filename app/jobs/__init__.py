"""Evaluation jobs: `evaluation` is the work, `job` its state, `store` keeps jobs on disk, `runner` is the queue.

`worker` is the process that runs one job.
"""
