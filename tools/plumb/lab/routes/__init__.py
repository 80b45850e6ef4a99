"""What the page may ask: a file for each subject, with its answers' models and its routes."""
