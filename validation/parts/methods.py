"""Which contact methods are too slow for which comparison."""

FULL_ONLY = ("bullet", "mujoco", "trimesh")
TOO_SLOW = "trimesh"  # milliseconds a point: minutes for the seconds that a torque takes
