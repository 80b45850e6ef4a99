"""The lab in the browser: a server on this computer alone, and the page that it serves.

The server owns no physics and no statistics: it calls the package's functions and keeps a folder.
"""
