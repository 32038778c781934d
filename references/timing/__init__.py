"""Workloads and the stopwatch of all timings."""
