"""The studies, one file a question; no study imports another."""
