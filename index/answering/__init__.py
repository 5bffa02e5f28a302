"""From a query to an answer: localizers, their results, evidence and the words for a place.

`localizer` opens an index and answers queries; `posterior_localizer` and `vector_localizer` find a position
distribution, and `result` turns either into the answer.
"""
