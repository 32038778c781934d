"""Benchmarks of the engine, the references and the release gate."""

import fctd  # noqa: F401 (fctd sets the folder of compiled code, and the reference kernel does not import fctd)
