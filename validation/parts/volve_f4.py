"""Well 15/9-F-4 of the Volve field: which rows fit, which judge, and how both are judged.

This file and the cases and setups of the well were committed before the first comparison.  Their author had seen the
series and, in the words of the question and of the description of the data, these numbers of daily reports: 7 kN m of
torque of the drilling string at 2,740 m, 6 to 9 of the wiper string at 2,650 m, and that friction factors of 0.12 to
0.18 fit torque and 0.17 to 0.22 the spread of weights.

Rules of reading.

- A daily report: ``up_weight_t`` and ``down_weight_t`` are strokes, ``trip_out`` and ``trip_in`` at the default speed;
  ``rotating_weight_t`` and torque are ``rotate_off_bottom``, where the string rotates (a torque at 0 rpm is not a
  rotating torque and is left out).  A range of rotation has its middle.  Row F4-13r rotates on its way up and down:
  ``back_ream`` and ``trip_in`` at 0.1 m/s, which is assumed.  1 t is 1000 kgf, block included.
- The series: medians of 25 m bins, at their middle.  ``rot_static``, ``rot_up`` and ``rot_dn`` give hook load and
  torque, ``pickup`` and ``slackoff`` hook load, ``in_slips`` the block's weight, and the torque of the free drive where
  half of its readings lie within 0.5 kN m (no connection is made up).  ``norot_static`` has no direction of friction
  and is left out.  Speeds along the hole are those of the samples (median of the block's speed above 0.01 m/s, bit
  more than 1 m off bottom, by direction and with or without rotation).

Rules of judging.  A torque or half the spread of up and down weight is inside a band where its recorded range meets it;
a single number is a range without width, and half a spread has noise of its two readings.  The absolute weight is
judged where another row of the same string fixed its mass (F4-07 alone).  F4-02 has no depth of its own and F4-T0 is a
tare of another string: they fit nothing and judge nothing.  Distance: from the prediction's median to the recorded
range, over the range's middle, 0 within.
"""

from typing import Final

# The strings of the rows: cases.
STRINGS: Final = {
    "F4-01": "volve_f4_12in",
    "F4-03": "volve_f4_12in",
    "F4-06": "volve_f4_8in",
    "F4-07": "volve_f4_wiper",
    "F4-10": "volve_f4_wiper",
    "F4-11": "volve_f4_scraper",
    "F4-13": "volve_f4_cleanup",
    "F4-13r": "volve_f4_cleanup",
}
# The series stands for all of its bins; its string.
SERIES: Final = "series"
SERIES_STRING: Final = "volve_f4_12in"

# Split A, the paper's rule: the rows of the 12 1/4 in section predict those of the 8 1/2 in section.
FIT_A: Final = (SERIES, "F4-01", "F4-03")
JUDGED_A: Final = ("F4-06", "F4-07", "F4-10", "F4-11", "F4-13", "F4-13r")
# Split B: the constants of the rig from the series, cased friction and masses from three rows, judged on three others.
FIT_RIG: Final = (SERIES,)
FIT_B: Final = ("F4-06", "F4-10", "F4-11")
JUDGED_B: Final = ("F4-07", "F4-13", "F4-13r")

# What a judged row is judged on; the weight at rest only where the string's mass is fixed by another row.
ABSOLUTE: Final = ("F4-07",)
