"""`python -m analysis FILE.csv --column NAME` runs the campaign `time_series`, which judges a column of a file."""

import runpy

if __name__ == "__main__":
    runpy.run_module("campaigns.time_series", run_name="__main__")
