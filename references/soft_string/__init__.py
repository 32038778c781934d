"""The soft string: integrated, in closed form, and as torsion springs with dry friction."""
