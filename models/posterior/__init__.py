"""The hint posterior: where a description was said, as a distribution over positions of a map."""
