"""The string at rest in its motion: root finding, charts, and the choice of segments."""
