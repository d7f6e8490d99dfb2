"""The report of `campaigns.oscillator`."""
