"""The follow-up question for an ambiguous answer, and the likelihood of its replies."""
