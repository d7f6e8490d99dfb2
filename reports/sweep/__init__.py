"""The report of `campaigns.sweep`: one or two varied keys, every column of the table over them."""
