"""What all campaigns share: whatever turns a list of runs into a folder of results, safe to interrupt and to resume."""
