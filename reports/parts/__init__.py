"""What all reports share: the records a report is made of, how they become HTML and PDF, and how things are said."""
