"""When chains or sheet are no longer where the machine believes: whole links, home marks."""
