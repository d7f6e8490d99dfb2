"""Any column of a file, judged by `python -m analysis --out DIR`."""
