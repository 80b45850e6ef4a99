"""Packs the wheel for Windows: that of this computer, its compiled modules exchanged.

python tools/windows/pack.py FOLDER_OF_MODULES FOLDER_FOR_THE_WHEEL
"""

import base64
import hashlib
import sys
import zipfile
from pathlib import Path
from tempfile import TemporaryDirectory

from scikit_build_core.build import build_wheel

TAG = "cp311-cp311-win_amd64"
COMMAND = "[console_scripts]\nplumb = plumb.cli.start:start\n"  # pip makes plumb.exe of it


def pack(modules: Path, folder: Path) -> Path:
    """Write the wheel, and return its path."""
    with TemporaryDirectory() as built:
        here = Path(built) / build_wheel(built)
        with zipfile.ZipFile(here) as archive:
            contents = {name: archive.read(name) for name in archive.namelist()}
        name, version, *_ = here.stem.split("-")
    info = f"{name}-{version}.dist-info"
    contents = {
        path: content
        for path, content in contents.items()
        if not path.endswith((".so", "/RECORD")) and ".data/" not in path
    }
    contents |= {f"plumb/{module.name}": module.read_bytes() for module in modules.iterdir()}
    contents[f"{info}/entry_points.txt"] = COMMAND.encode()
    head = contents[f"{info}/WHEEL"].decode().split("\nTag:")[0]
    contents[f"{info}/WHEEL"] = f"{head}\nTag: {TAG}\n".encode()
    record = "".join(
        f"{path},sha256={_digest(each)},{len(each)}\n" for path, each in contents.items()
    )
    contents[f"{info}/RECORD"] = f"{record}{info}/RECORD,,\n".encode()
    wheel = folder / f"{name}-{version}-{TAG}.whl"
    with zipfile.ZipFile(wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for path, content in contents.items():
            archive.writestr(path, content)
    return wheel


def _digest(content: bytes) -> str:
    """Return a digest as the RECORD of a wheel writes it."""
    return base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()


if __name__ == "__main__":
    print(pack(*map(Path, sys.argv[1:])))
