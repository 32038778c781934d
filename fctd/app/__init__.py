"""The live page: a case under sliders, served to this machine alone (``fctd app``).

The process that serves the page reads nothing that comes from outside: case, survey and measured rows go as they are
to a process of its own (worker.py), with limits of time and memory, which answers with numbers to draw.

Needs dash and waitress, which the package installs as its extra ``app``.
"""
