"""Optional packages that are not there, and how to have them."""

import sys

# The first Python that pybullet has no wheels for.
NO_PYBULLET = (3, 12)


def absent(distribution: str) -> str:
    """That a package is not installed, and how to have it."""
    if distribution == "pybullet" and sys.version_info >= NO_PYBULLET:
        how = "it has no wheels for Python 3.12 and later: run on Python 3.11, or build it by 'make bullet'"
    else:
        how = "it is part of the extra 'suite'"
    return f"{distribution}, which is not installed ({how})"
