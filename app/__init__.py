"""Delivery: the HTTP service and the command line. No arithmetic and no model code here."""
