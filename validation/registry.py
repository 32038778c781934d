"""Every study there is, in the order in which the report tells them: name -> module with ``STUDY``."""

STUDIES: dict[str, str] = {}
