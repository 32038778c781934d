"""Caliper logs: what a case says of one, the files, and the radii of the hole that follow."""
