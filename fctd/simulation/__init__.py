"""The string in time: settle, step through the schedule, record."""
