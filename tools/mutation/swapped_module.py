"""A pytest plugin: one module is read from another file, both as the environment names them."""

import importlib.abc
import importlib.util
import os
import sys


class OtherText(importlib.abc.MetaPathFinder, importlib.abc.SourceLoader):
    """Finds one module and loads another file's text for it."""

    def __init__(self, module: str, path: str):
        self.module, self.path = module, path

    def find_spec(self, fullname, path, target=None):
        """Find the module as if it were where its package is."""
        if fullname != self.module:
            return None
        return importlib.util.spec_from_loader(fullname, self)

    def get_filename(self, fullname):
        """Return where the text is."""
        return self.path

    def get_data(self, path):
        """Return the text."""
        with open(path, "rb") as file:
            return file.read()


if os.environ.get("MUTATED_MODULE"):
    sys.meta_path.insert(0, OtherText(os.environ["MUTATED_MODULE"], os.environ["MUTATED_TEXT"]))
