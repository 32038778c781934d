"""Code that several studies share, and parts of studies that would make their file too long."""
