"""Answers: what the public functions return, which notebooks show and which plots itself."""
