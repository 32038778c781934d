"""What WITSML files give of a new case: tables with the values of the file, and with blanks for what it lacks."""
