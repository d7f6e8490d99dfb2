"""The report of `campaigns.orbits`: periodic orbits along a key, stable and unstable, and what happens to them."""
