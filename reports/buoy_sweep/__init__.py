"""The report of `campaigns.buoy_sweep`: `report.py` says what comes in which order, the other files what is said."""
