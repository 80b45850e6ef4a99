"""What was measured on a sheet, and the files that hold it."""
