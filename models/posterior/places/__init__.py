"""Likelihood of mentions: kernels of distance and angle around named objects, streets, corners and addresses."""
