"""What speed is measured on, and the one stopwatch."""
