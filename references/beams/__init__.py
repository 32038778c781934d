"""Beams that are no chain of rigid segments: finite elements and a Cosserat rod."""
