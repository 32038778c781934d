"""Every study there is, in the order in which the report tells them: name -> module with ``STUDY``."""

STUDIES: dict[str, str] = {
    "paper_well": "validation.paper_well",
    "curved_chain": "validation.curved_chain",
    "scaled_section": "validation.scaled_section",
    "energy_ledger": "validation.energy_ledger",
    "cylinder_error": "validation.cylinder_error",
    "overlap": "validation.overlap",
    "ownership": "validation.ownership",
    "real_survey": "validation.real_survey",
}
