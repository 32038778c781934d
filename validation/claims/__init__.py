"""The paper's claims and their verdicts from the stored results of the studies."""
