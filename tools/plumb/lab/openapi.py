"""Writes the schema of the lab's routes, from which the page's types are made."""

from __future__ import annotations

import json
import sys
from pathlib import Path

from fastapi import FastAPI

from plumb.lab.app import ROUTERS


def schema() -> str:
    """Return the OpenAPI schema as JSON."""
    app = FastAPI(title="plumb lab")
    for router in ROUTERS:
        app.include_router(router, prefix="/api")
    return json.dumps(app.openapi(), indent=1)


if __name__ == "__main__":
    Path(sys.argv[1]).parent.mkdir(parents=True, exist_ok=True)
    Path(sys.argv[1]).write_text(schema())
