"""What lies on disk: locks, files and folders that are replaced as a whole, runs that have not ended, limits."""
