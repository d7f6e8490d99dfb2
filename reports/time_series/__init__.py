"""Any column of a file, judged by `python -m analysis --out DIR`: `report.py` says it, `folder.py` reads the folder."""
