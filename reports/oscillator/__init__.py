"""The report of `campaigns.oscillator`: `report.py` says what comes in which order, the other files what is said."""
