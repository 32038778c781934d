"""Benchmarks of the engine, the references and the gate."""
