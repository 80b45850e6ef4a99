"""The lab's web application: its routes, what a refusal looks like, and the guard before them."""

import json
import sys
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from importlib import import_module
from pathlib import Path
from pkgutil import iter_modules

from fastapi import FastAPI, Request
from fastapi.exceptions import RequestValidationError
from fastapi.responses import JSONResponse
from fastapi.staticfiles import StaticFiles
from starlette.exceptions import HTTPException
from starlette.middleware.gzip import GZipMiddleware
from starlette.types import ASGIApp

from plumb.lab import routes
from plumb.lab.background import Background, LiveBoards
from plumb.lab.guard import Address, Guard
from plumb.lab.machine_line import MachineLine
from plumb.lab.project import ChangedError, Project
from plumb.lab.routes.guide import GuideDesk
from plumb.lab.routes.phones import Phones
from plumb.text.errors import InputError, on_page

PAGE = Path(__file__).parent / "page"

# To add a route, write its file in the folder routes.
ROUTERS = tuple(
    import_module(f"{routes.__name__}.{each.name}").router for each in iter_modules(routes.__path__)
)

REFUSALS = (
    *(InputError, ValueError, ChangedError, RequestValidationError),
    *(OSError, HTTPException, Exception),
)


def lab_app(folder: Path, *, address: Address, token: str, paired: Phones | None = None) -> ASGIApp:
    """Return the lab of a folder, for a server on this address whose page knows the token."""
    paired = paired or Phones()
    line = MachineLine()

    @asynccontextmanager
    async def lifespan(app: FastAPI) -> AsyncIterator[None]:
        yield
        line.disconnect()

    app = FastAPI(
        title="plumb lab", docs_url=None, redoc_url=None, openapi_url=None, lifespan=lifespan
    )
    app.state.line, app.state.phones = line, paired
    app.state.project = Project(folder)
    app.state.live_boards, app.state.background = LiveBoards(), Background()
    app.state.guide_desk = GuideDesk()
    for router in ROUTERS:
        app.include_router(router, prefix="/api")
    for kind in REFUSALS:
        app.add_exception_handler(kind, _refused)
    app.add_middleware(GZipMiddleware)
    app.mount("/", StaticFiles(directory=PAGE, html=True))
    return Guard(app, address=address, token=token, phones=paired)


async def _refused(request: Request, error: Exception) -> JSONResponse:
    """Return why a request was refused, in a line."""
    line, status = _reason(error)
    return JSONResponse({"error": line}, status, getattr(error, "headers", None))


def _reason(error: Exception) -> tuple[str, int]:
    match error:
        case ChangedError():  # by another program
            return str(error), 409
        case RequestValidationError():  # not of the form of the schema
            first = error.errors()[0]
            return f"{'.'.join(str(part) for part in first['loc'][1:])}: {first['msg']}", 422
        case InputError() | ValueError():
            return on_page(error), 422
        case OSError():  # a disk that is full, a folder that is gone: the page tries again later
            place = f"{Path(error.filename).name}: " if isinstance(error.filename, str) else ""
            return f"{place}{error.strerror or error}", 507
        case HTTPException():  # no such route or file, or a body that is none
            return str(error.detail), error.status_code
    return f"the lab has a fault ({type(error).__name__}); its terminal shows where", 500


def schema() -> str:
    """Return the OpenAPI schema as JSON."""
    app = FastAPI(title="plumb lab")
    for router in ROUTERS:
        app.include_router(router, prefix="/api")
    return json.dumps(app.openapi(), indent=1)


if __name__ == "__main__":
    Path(sys.argv[1]).parent.mkdir(parents=True, exist_ok=True)
    Path(sys.argv[1]).write_text(schema())
