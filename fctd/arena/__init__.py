"""What a contact method is, the holes that judge one with exact answers, and the contract that every method is held to.

Nothing here needs more than numpy and pydantic.
"""
