"""The case file: units, tables, survey files, and `load_case`; all floats are SI once read."""
