"""Pictures of errors, fields, reach and plans on the sheet."""
