"""Routes of the page: a file for each subject, with the models of its answers."""
