"""The report: a page with all that the marks say of a machine, to keep and to print."""
