"""The report of `campaigns.accuracy`: `report.py` says what comes in which order, the other files what is said."""
