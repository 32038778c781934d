"""What everything costs."""

import fctd  # noqa: F401 (it says where compiled code is kept, and the reference kernel imports nothing of it)
