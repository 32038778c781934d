"""What a case describes: survey, wellbore, drill string and operations, ready for the mechanics."""
