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
from plumb.lab.guide_desk import GuideDesk
from plumb.lab.machine_line import MachineLine
from plumb.lab.phones import Phones
from plumb.lab.project import ChangedError, Project
from plumb.text.errors import InputError, on_page

PAGE = Path(__file__).parent / "page"

# To add a route, write its file in the folder routes.
ROUTERS = tuple(
    import_module(f"{routes.__name__}.{each.name}").router for each in iter_modules(routes.__path__)
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
    app.add_exception_handler(InputError, _refusal)
    app.add_exception_handler(ValueError, _refusal)
    app.add_exception_handler(ChangedError, _changed)
    app.add_exception_handler(RequestValidationError, _misunderstood)
    app.add_exception_handler(OSError, _unable)
    app.add_exception_handler(HTTPException, _unknown)
    app.add_exception_handler(Exception, _failed)
    app.add_middleware(GZipMiddleware)
    app.mount("/", StaticFiles(directory=PAGE, html=True))
    return Guard(app, address=address, token=token, phones=paired)


async def _refusal(request: Request, error: Exception) -> JSONResponse:
    """Return what cannot be used, in a line."""
    return JSONResponse({"error": on_page(error)}, 422)


async def _changed(request: Request, error: Exception) -> JSONResponse:
    """Return a file that another program changed."""
    return JSONResponse({"error": str(error)}, 409)


async def _misunderstood(request: Request, error: Exception) -> JSONResponse:
    """Return a request that does not have the form of the schema."""
    assert isinstance(error, RequestValidationError)
    first = error.errors()[0]
    place = ".".join(str(part) for part in first["loc"][1:])
    return JSONResponse({"error": f"{place}: {first['msg']}"}, 422)


async def _unable(request: Request, error: Exception) -> JSONResponse:
    """Return a disk that is full, a folder that is gone: the page tries again later."""
    assert isinstance(error, OSError)
    place = f"{Path(error.filename).name}: " if isinstance(error.filename, str) else ""
    return JSONResponse({"error": f"{place}{error.strerror or error}"}, 507)


async def _unknown(request: Request, error: Exception) -> JSONResponse:
    """Return a route or a file that is not there, or a body that is none."""
    assert isinstance(error, HTTPException)
    return JSONResponse({"error": str(error.detail)}, error.status_code, error.headers)


async def _failed(request: Request, error: Exception) -> JSONResponse:
    """Return a fault of the lab itself; the terminal shows where."""
    line = f"the lab has a fault ({type(error).__name__}); its terminal shows where"
    return JSONResponse({"error": line}, 500)


def schema() -> str:
    """Return the OpenAPI schema as JSON."""
    app = FastAPI(title="plumb lab")
    for router in ROUTERS:
        app.include_router(router, prefix="/api")
    return json.dumps(app.openapi(), indent=1)


if __name__ == "__main__":
    Path(sys.argv[1]).parent.mkdir(parents=True, exist_ok=True)
    Path(sys.argv[1]).write_text(schema())
