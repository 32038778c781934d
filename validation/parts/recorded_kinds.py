"""The operations that studies run through.

Their verdicts are recorded, and their random wells drawn, with these: a later kind would change counts and draws.
"""

from typing import Final

RECORDED_KINDS: Final = (
    "trip_in", "trip_out", "rotate_off_bottom", "back_ream", "drill_rotating", "drill_sliding",
)  # fmt: skip
