"""Language: sentences to features, descriptions to hints, hints to sentences."""
