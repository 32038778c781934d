"""Every study there is, in the order in which the report tells them: name -> module with ``STUDY``."""

STUDIES: dict[str, str] = {
    "paper_well": "validation.paper_well",
    "curved_chain": "validation.curved_chain",
    "energy_ledger": "validation.energy_ledger",
    "cylinder_error": "validation.cylinder_error",
    "overlap": "validation.overlap",
    "ownership": "validation.ownership",
    "soft_limit": "validation.soft_limit",
    "real_survey": "validation.real_survey",
}
