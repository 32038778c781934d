"""The steady string: root finding, torque-and-drag charts, and the choice of segments."""
