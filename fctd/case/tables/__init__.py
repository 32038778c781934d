"""Tables that people write, as texts or sheets: surveys, series of readings, measured rows.

A table has rows of headers and cells; a `fields.Form` says which fields it may have, what their headers are called and
in which units they stand.  `text` finds encoding, separator and rows of a text, `headers` the columns and their units,
and `rows.Rows` has the cells and the numbers in them.  Every error names row and column.
"""
