"""The paper's claims and how they are judged by what the studies stored."""
