"""Integration in time: Newton, one step of every method, step control, statics, even output, status codes."""
