"""The report of `campaigns.out_of_plane`: `report.py` says what comes in which order, the other files what is said."""
