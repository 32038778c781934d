"""Calibration: unknowns of a well from its measured hook loads and torques, and predictions with bands."""
