"""Benchmarks of the engine, the references and the release gate."""

import fctd.mechanics.jit  # noqa: F401 (it sets the folder of compiled code; the reference kernel does not import fctd)
