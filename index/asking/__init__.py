"""The next question for a person whose answer is ambiguous, and what replies change."""
