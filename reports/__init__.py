"""The page that shows what the studies found, written by ``python -m reports``; it computes no physics."""
