"""Evaluations beside the service: what is asked (`order`), its state (`job`), the line of them (`runner`), its process.

`worker` is that process. May import app.http for its errors and requests, index and models, which the process opens.
"""
