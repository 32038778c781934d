"""Results: columns, statuses, notes, profiles, units of display, and files that are replaced atomically."""
