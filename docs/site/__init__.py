"""What the docs site needs beyond Sphinx: equations as MathML, docstrings and guides as they are, pages of rooms."""
