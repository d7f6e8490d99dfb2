"""The report of `campaigns.breaking_line`: `report.py` says what comes in which order, the other files what is said."""
