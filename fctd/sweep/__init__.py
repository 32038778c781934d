"""Sweeps: many samples of a case's keys, computed on all cores or on a cluster, and the uncertainty that they show."""
