"""Limits of requests; GET /info gives most of them, and the OpenAPI document those of single fields."""

from typing import Final

MAX_CONNECTIONS: Final = 900  # more get 503; leaves file descriptors for files and workers if `ulimit -n` is 1,024
MAX_BODY_BYTES: Final = 262_144  # 16 times the longest description in UTF-8
MAX_BATCH_BODY_BYTES: Final = 4 * MAX_BODY_BYTES
MAX_EVALUATE_BODY_BYTES: Final = 16_777_216  # MAX_EVALUATE_QUERIES of 1.6 kB each
MAX_DESCRIPTION_CHARACTERS: Final = 4000  # the longest text in models/reports/texts has 220
MAX_HINTS: Final = 32  # texts in models/reports/texts have at most 5 sentences
MAX_SENTENCES: Final = 200  # a transcript of 4,000 characters has up to 120; vector search takes 10 ms each
MAX_PLACES: Final = 5  # in an answer (models/posterior/modes.py)
MAX_BATCH_ITEMS: Final = 64
MAX_VERTICES: Final = 2000  # of `within`; the test of 1,000,000 cells takes about a second
MAX_BATCH_ROWS: Final = 1000  # of a CSV table: with two CPUs, less than the minute after which proxies give up
MAX_TOP_K: Final = 40  # the maximum of Nominatim's `limit`
MAX_WAITING_QUERIES: Final = 256  # bounds memory; max_wait_ms refuses most queries earlier
DEFAULT_DEADLINE_MS: Final = 10_000
MAX_DEADLINE_MS: Final = 60_000  # shutting down takes as long: keep terminationGracePeriodSeconds in docker/ above it
MAX_EVALUATE_QUERIES: Final = 10_000  # minutes of work
MAX_WAITING_JOBS: Final = 8  # evaluations
