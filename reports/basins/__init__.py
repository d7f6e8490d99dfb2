"""The report of `campaigns.basins`: which start ends in which motion, and how little leads to the worst."""
