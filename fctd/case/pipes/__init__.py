"""Pipe by its name: a catalogue of nominal geometry, each row with the page that prints it, and grades of steel."""
