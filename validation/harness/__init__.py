"""What runs, stores and judges studies."""
