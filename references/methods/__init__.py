"""Contact methods and engines compared on any well; ``python -m references methods CASE``."""

from references.methods.compare import compare_methods as compare_methods
