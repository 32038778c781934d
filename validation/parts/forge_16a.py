"""Well 16A(78)-32 of Utah FORGE: which rows fit, which judge, how they are read and how they are judged.

This file, the cases and the setup were committed before the first prediction, and the fitted values before the judged
rows were read.  The study is retrospective all the same: others have looked at this well.  Its author had seen the rows
that fit and, in the description of the data, that weights ask for a friction factor that grows from 0.1 (nearly
vertical) to 0.35 to 0.45 in the tangent and torques for 0.1 to 0.22, that the tare is about 52 klbf, and that the
rotating weight at 9,961 ft lies below its neighbours; no reading of a judged row.

Rules of reading.

- A row is one report: pick-up weight (``trip_out``) and slack-off weight (``trip_in``) are strokes at the default
  speed, rotating weight and torque are ``rotate_off_bottom``.  Rotation is not recorded; 60 rev/min are assumed, and
  with Coulomb friction nothing but the offset of the torque depends on it.
- Readings are rounded: to 5 klbf and 1,000 ft lbf.  It is not said whether the bit was on bottom while the torque was
  read (``torque_read = "unknown"``).
- Numbers below 1,000 are klbf.  The rows of 5,300 ft with and without pumps are recorded and fit nothing: lift explains
  a third of their difference at most.
- Row 5950 (grade B) stands for a bit between 5,634 and 6,263 ft; its middle is taken.

Rules of the strings.

- The assembly of a row is the list of its date (``forge_16a_strings``), which says how masses follow from dimensions
  and from the printed weights.  Drill pipe is 5 in with 21.9 lb/ft.
- Row 8466 was measured with a packer on heavy-weight pipe (its note), not with the listed assembly: the list has the
  same heavy-weight pipe and stands for it, with a wider prior of its mass.
- The list of 9,961 ft is 1,117 ft shorter than the length that is printed: twelve stands of 93.1 ft, which are taken as
  the heavy-weight pipe that the strings before had.

Rules of the fit.  All twelve rows to 8,391 ft are fitted together, with scatter between days: tare (block and drive),
sheave efficiency, torque offset, friction along and around cased and open hole, masses.  So no reading is used twice.
Friction of the open hole may be linear in depth: of the two fits the one is judged that predicts left-out days better;
both scores are printed.  The tare and its scatter from day to day that follow from the rotating weights at 5,042 to
6,016 ft alone, with the masses as they are described, are fitted apart and stand beside it.  The soft string and one
friction factor for both directions are fitted to the same rows with the same priors.

Rules of judging (``judging``).  A reading is inside a band where the middle of its recorded range is.  Coverage, CRPS,
bias and the count outside are for the four quantities of the two rows of grade A (9,064 and 9,748 ft), and apart for
8,466 and 9,961 ft.  "Carried on" is the reading of 8,391 ft, the last row that fits.
"""

from typing import Final

# Rows by bit depth [ft], as in the file of the readings.
FIT: Final = ("4811", "5042", "5390", "5495", "5641", "5878", "5950", "6016", "6507", "6724", "7990", "8391")
JUDGED: Final = ("9064", "9748")
APART: Final = ("8466", "9961")
# Rotating weights of these rows alone give the tare that is printed beside that of the fit.
TARE: Final = ("5042", "5390", "5495", "5641", "5878", "5950", "6016")
# Recorded with and without pumps, and never fitted.
PUMPS: Final = "5300"
# The row whose string is that of its note.
OF_NOTE: Final = "8466"
# Rows of the 12 1/4 in section.
UPPER: Final = ("4811", "5042")

RPM: Final = 60.0
