"""The ladder: rungs whose exact or published answers the engine must give, a file for each family.

A family is a module with ``RUNGS``; ``study.FAMILIES`` names them.
"""
