"""Prints the path of one description or of one map through the code: the files that run, in the order first entered.

    python docs/trace.py description --index data/index "I stand on a gray road. A park is to my west."
    python docs/trace.py map models/maps/helsinki.osm.pbf

A description is a POST /localize to the service in this process, its model too, from the route to the response; the
service is ready before, as it is for users, and what runs before the route (middleware, checks of the body) is named
apart. A map is the command `index`, from the command to the files written, into a directory that is deleted after. Each
file comes with the function that was entered first, and with how many different functions and lines of it ran. What
runs while a module is imported does not count. Files of which fewer than SMALL lines ran are helpers, and listed apart.
All threads are followed; what other processes would share of a map's work is done in this one. Settings are the
HEREABOUTS_ variables.
"""
# ruff: noqa: PLC0415  # tracing begins before what is traced is imported

import argparse
import os
import sys
import tempfile
import threading
import time
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from types import CodeType, FrameType
from typing import Any

ROOT = Path(__file__).resolve().parent.parent
TRACED = tuple(f"{ROOT / layer}{os.sep}" for layer in ("app", "index", "models"))
ROUTES = "app/http/routes/"
SMALL = 20
IMPORTING = "<frozen importlib._bootstrap>"
READY_S = 300


@dataclass(slots=True)
class Ran:
    """What ran of a file: the function entered first, the code of all, the numbers of the lines."""

    first: str
    functions: set[CodeType] = field(default_factory=set)
    lines: set[int] = field(default_factory=set)


class Tracer:
    """Notes what runs of this repository while `is_on`, in all threads that start after `start`."""

    def __init__(self) -> None:
        self.is_on = False
        self.files: dict[str, Ran] = {}
        self.before: dict[str, Ran] = {}
        self._starts_at: str | None = None

    def start(self) -> None:
        """Follow this thread and those to come."""
        threading.settrace(self._enter)
        sys.settrace(self._enter)

    def stop(self) -> None:
        """Follow nothing any more."""
        self.is_on = False
        sys.settrace(None)
        threading.settrace(None)

    def begin(self, at: str | None = None) -> None:
        """Note what runs from now on; what runs before a file below `at` is entered goes to `before`."""
        self._starts_at, self.is_on = at, True

    def _enter(self, frame: FrameType, _event: str, _argument: Any) -> Any:
        """Called by Python for every function that is entered, or goes on after an await or a yield."""
        if not frame.f_code.co_filename.startswith(TRACED) or _is_import(frame):
            return None
        if self.is_on:
            self._note(frame.f_code)
        return self._line

    def _line(self, frame: FrameType, event: str, _argument: Any) -> Any:
        """Called by Python for every line of a function that was entered."""
        if self.is_on and event == "line":
            self._note(frame.f_code).lines.add(frame.f_lineno)
        return self._line

    def _note(self, code: CodeType) -> Ran:
        name = _name(code.co_filename)
        if self._starts_at and name.startswith(self._starts_at):
            self._starts_at, self.before, self.files = None, self.files, {}
        ran = self.files.setdefault(name, Ran(code.co_qualname.replace(".<locals>", "")))
        if not code.co_name.startswith("<"):  # a comprehension is lines of the function that it stands in
            ran.functions.add(code)
        return ran

    def report(self) -> str:
        """A table of the files in order, then the helpers, then what ran before."""
        large = {name: ran for name, ran in self.files.items() if len(ran.lines) >= SMALL}
        small = {name: ran for name, ran in self.files.items() if len(ran.lines) < SMALL}
        head = ("", "file", "entered first", "functions", "lines")
        rows = [head] + [
            (str(n), name, ran.first, str(len(ran.functions)), str(len(ran.lines)))
            for n, (name, ran) in enumerate(large.items(), start=1)
        ]
        widths = [max(len(row[column]) for row in rows) for column in range(len(head))]
        align = (str.rjust, str.ljust, str.ljust, str.rjust, str.rjust)
        table = "\n".join(
            "  ".join(put(cell, width) for put, cell, width in zip(align, row, widths, strict=True)) for row in rows
        )
        functions, lines = (sum(len(getattr(ran, what)) for ran in large.values()) for what in ("functions", "lines"))
        parts = [table, f"{len(large)} files, {functions} functions, {lines} lines"]
        parts.append(f"helpers, fewer than {SMALL} lines each: {_listed(small)}")
        only_before = {name: ran for name, ran in self.before.items() if name not in self.files}
        return "\n".join([*parts, f"only before the route: {_listed(only_before)}"] if self.before else parts)


@cache
def _name(filename: str) -> str:
    return Path(filename).relative_to(ROOT).as_posix()


def _is_import(frame: FrameType) -> bool:
    """Whether a function runs because a module is being imported."""
    above: FrameType | None = frame
    while above is not None:
        if above.f_code.co_filename == IMPORTING:
            return True
        above = above.f_back
    return False


def _listed(files: dict[str, Ran]) -> str:
    return ", ".join(f"{name} ({len(ran.lines)})" for name, ran in files.items()) or "none"


def trace_description(index_dir: Path, text: str) -> None:
    """Ask the service, print the path."""
    tracer = Tracer()
    tracer.start()
    from fastapi.testclient import TestClient

    from app.logs import configure_logging
    from app.main import create_app, open_order
    from app.settings import load_settings

    configure_logging("error")
    settings = load_settings(index_dir=index_dir, read_key=None)
    with TestClient(create_app(settings, open_order(settings).open)) as client:  # in this process, not in a worker
        end_s = time.monotonic() + READY_S
        while (ready := client.get("/readyz")).status_code != 200:
            if ready.json().get("code") == "load_failed" or time.monotonic() > end_s:
                sys.exit(f"the service does not become ready: {ready.text}")
            time.sleep(0.05)
        tracer.begin(at=ROUTES)
        response = client.post("/localize", json={"description": text})
        tracer.stop()
    body = response.json()
    print(f"POST /localize {text!r}: {response.status_code}, {body.get('status', body.get('code'))}")
    print(tracer.report())


def trace_map(map_path: Path) -> None:
    """Index a map, print the path and the files written."""
    tracer = Tracer()
    tracer.start()
    from app.cli.main import app
    from models.processes import one_process

    with one_process(), tempfile.TemporaryDirectory() as directory:
        tracer.begin()
        app(["index", "--map", str(map_path), "--out", directory], standalone_mode=False)
        tracer.stop()
        files = {path: path.stat().st_size for path in sorted(Path(directory).rglob("*")) if path.is_file()}
        print(f"hereabouts index --map {map_path.name}: {len(files)} files")
        print(tracer.report())
        print("written: " + ", ".join(f"{path.name} ({size:,} bytes)" for path, size in files.items()))


def main() -> None:
    """Read the command line."""
    sys.path[0] = str(ROOT)  # in place of docs/, whose trace.py would hide the library's
    parser = argparse.ArgumentParser(description="Prints which files of this repository run, in order.")
    commands = parser.add_subparsers(dest="command", required=True)
    description = commands.add_parser("description", help="the path of one description")
    description.add_argument("--index", type=Path, required=True, help="directory that 'hereabouts index' wrote")
    description.add_argument("text", help="what is around you")
    city = commands.add_parser("map", help="the path of one map")
    city.add_argument("map", type=Path, help="any map that 'hereabouts index' takes")
    asked = parser.parse_args()
    if asked.command == "description":
        trace_description(asked.index, asked.text)
    else:
        trace_map(asked.map)


if __name__ == "__main__":
    main()
