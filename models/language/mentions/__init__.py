"""Mentions of names, kinds, streets, corners and addresses in a text, and where each is from the speaker."""
