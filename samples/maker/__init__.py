"""The builders, the checks and the writer behind make-samples.py."""
