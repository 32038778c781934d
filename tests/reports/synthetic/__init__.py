"""Invented tables with the columns and roughly the sizes of the studies' own, to draw figures from.

A function for each study, by the study's name.
"""

from validation.harness import registry

from . import contact, in_time, motion, paper, segments, steady

STUDIES = {
    name: function
    for module in (paper, contact, steady, motion, in_time, segments)
    for name, function in vars(module).items()
    if name in registry.STUDIES
}
