"""Workloads and the stopwatch of all timings."""

import fctd.mechanics.jit  # noqa: F401 (it sets the folder of compiled code; the reference kernel does not import fctd)
