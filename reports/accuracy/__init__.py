"""The report of `campaigns.accuracy`."""
