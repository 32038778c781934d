"""Every study there is, in the order in which the report tells them: name -> module with ``STUDY``."""

STUDIES: dict[str, str] = {
    "paper_well": "validation.paper_well",
    "curved_chain": "validation.curved_chain",
    "scaled_section": "validation.scaled_section",
    "energy_ledger": "validation.energy_ledger",
    "cylinder_error": "validation.cylinder_error",
    "overlap": "validation.overlap",
    "ownership": "validation.ownership",
    "steady_state": "validation.steady_state",
    "soft_limit": "validation.soft_limit",
    "beam_in_hole": "validation.beam_in_hole",
    "johancsik": "validation.johancsik",
    "segment_count": "validation.segment_count",
    "refine": "validation.refine",
    "contact_accuracy": "validation.contact_accuracy",
    "contact_swap": "validation.contact_swap",
    "engines_agree": "validation.engines_agree",
    "real_survey": "validation.real_survey",
    "real_chart": "validation.real_chart",
    "refine_real": "validation.refine_real",
}
