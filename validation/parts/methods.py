"""Which contact methods are too slow for which comparison."""

FULL_ONLY = ("bullet", "mujoco", "trimesh")
TOO_SLOW = "trimesh"  # milliseconds per point: minutes for the simulated seconds that a torque needs
