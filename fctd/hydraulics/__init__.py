"""Mud that flows: pressures along a string, and the pull of the mud on it."""
