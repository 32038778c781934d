"""Strings and holes of WITSML 1.3.1 and 1.4.1: the objects ``tubular`` and ``wbGeometry``, as their files have them."""
