"""The report of `campaigns.stability`: `report.py` says what comes in which order, the other files what is said."""
