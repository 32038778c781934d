"""Laminar flow of a Herschel-Bulkley mud beside a pipe that moves, exact: the referee of the closed forms."""
