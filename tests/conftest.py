"""Settings of every test."""

import hypothesis

# The first call of a compiled function takes seconds, and CI must fail the same way twice.
hypothesis.settings.register_profile("fctd", deadline=None, derandomize=True)
hypothesis.settings.load_profile("fctd")
