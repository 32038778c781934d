"""Result tables: profiles, units for readers, and files that are written whole or not at all."""
