"""Limits that clients can run into; GET /info shows most of them, the OpenAPI document those of request fields."""

from typing import Final

MAX_CONNECTIONS: Final = 900  # above it 503; leaves descriptors for files and workers where `ulimit -n` is 1,024
MAX_BODY_BYTES: Final = 262_144  # 16 times what the longest description takes in UTF-8
MAX_BATCH_BODY_BYTES: Final = 4 * MAX_BODY_BYTES
MAX_EVALUATE_BODY_BYTES: Final = 16_777_216  # MAX_EVALUATE_QUERIES of 1.6 kB each
MAX_DESCRIPTION_CHARACTERS: Final = 4000  # texts in models/reports/people have up to 220
MAX_HINTS: Final = 32  # or sentences of a description; texts in models/reports/people have up to 5
MAX_BATCH_ITEMS: Final = 64
MAX_TOP_K: Final = 40  # as Nominatim's `limit`
MAX_WAITING_QUERIES: Final = 256  # far more than are answered within the longest wait; bounds memory
DEFAULT_DEADLINE_MS: Final = 10_000
MAX_DEADLINE_MS: Final = 60_000  # a service that ends waits as long; see terminationGracePeriodSeconds in docker/
MAX_EVALUATE_QUERIES: Final = 10_000  # minutes of work
MAX_WAITING_JOBS: Final = 8  # evaluations
