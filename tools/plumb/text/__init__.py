"""Text in and out: files, single values that people type, and the errors that people see."""
