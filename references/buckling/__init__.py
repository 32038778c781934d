"""Buckled pipe on the wall of its hole: limits, shapes, wall forces and transmitted force."""
