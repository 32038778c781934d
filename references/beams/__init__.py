"""Beam models other than a chain of rigid segments: finite elements and a Cosserat rod."""
