"""The model of a case for the mechanics: survey, wellbore, drill string and operations."""
