"""The report of `campaigns.sea`."""
