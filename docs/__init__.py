"""The guides, and the command that makes what they show: ``python -m docs``."""
