"""`python -m analysis FILE.csv --column NAME`: any column of a file, judged by the campaign `time_series`."""

import runpy

if __name__ == "__main__":
    runpy.run_module("campaigns.time_series", run_name="__main__")
