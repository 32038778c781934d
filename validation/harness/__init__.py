"""Runs, stores and judges studies."""
