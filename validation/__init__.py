"""The studies: one file per question, each giving tables and checks, run by ``python -m validation``."""
