"""The report of `campaigns.validation`: a table of all cases, then a page a case."""
