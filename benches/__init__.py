"""Measurements: `make validate` and `make bench`."""
