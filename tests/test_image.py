"""The image runs as nobody, may write next to nowhere, and ends in time; and the service is content with that."""

import json
import os
import re
import shlex
import shutil
import subprocess
import sys
from contextlib import suppress
from pathlib import Path
from typing import Any

import httpx
import pytest
import yaml

from app.limits import MAX_DEADLINE_MS
from app.server import CLOSING_S
from tests.app.conftest import is_ready, wait_until
from tests.dockerfile import argument_of, command_of, instructions, user_id

ROOT = Path(__file__).parent.parent
COMPOSE = yaml.safe_load((ROOT / "docker/docker-compose.yml").read_text())
SERVICES = COMPOSE["services"]
OURS = [name for name, service in SERVICES.items() if service["image"] == "hereabouts"]
APIS = ("api", "api-milvus")
NOBODY = 10_001  # on no machine a user of that number
TEXT = "I am north of a gray building. A black pole is to my west."
ANYBODYS = ("/tmp", "/var/tmp", "/dev/shm")


def run_here(words: list[str]) -> list[str]:
    """Return a command of the image for this machine's Python."""
    return [sys.executable, *words[1:]] if words[0] == "python" else [sys.executable, "-m", "app.cli.main", *words[1:]]


def test_the_image_runs_as_a_user_that_is_not_root() -> None:
    assert user_id() > 0
    order = [name for name, _ in instructions()]
    assert order.index("USER") > max(number for number, name in enumerate(order) if name in ("RUN", "COPY"))


@pytest.mark.parametrize("name", SERVICES)
def test_a_container_may_do_next_to_nothing(name: str) -> None:
    service = SERVICES[name]
    assert service["cap_drop"] == ["ALL"]
    assert "cap_add" not in service
    assert not service.get("privileged")
    assert service["security_opt"] == ["no-new-privileges:true"]


@pytest.mark.parametrize("name", OURS)
def test_a_container_of_ours_may_write_next_to_nowhere(name: str) -> None:
    service = SERVICES[name]
    assert service["read_only"] is True
    assert service["tmpfs"] == ["/tmp"]
    assert "user" not in service, "the image's own"


@pytest.mark.parametrize(("name", "index"), [("api", "index"), ("api-milvus", "index-milvus")])
def test_the_service_cannot_write_the_index_and_is_reached_from_this_machine_alone(name: str, index: str) -> None:
    api = SERVICES[name]
    writable = [volume.split(":")[1] for volume in api["volumes"] if not volume.endswith(":ro")]
    assert writable == ["/jobs"]
    assert f"{index}:/data:ro" in api["volumes"]
    assert f"{index}:/data" in SERVICES[index]["volumes"]
    assert api["ports"]
    assert all(port.startswith("127.0.0.1:") for port in api["ports"])
    assert not any("ports" in service for name, service in SERVICES.items() if name not in APIS)
    assert "/maps:ro" in "".join(SERVICES[index]["volumes"])


def test_milvus_is_there_for_those_alone_who_name_its_profile() -> None:
    assert {name for name, service in SERVICES.items() if "profiles" not in service} == {"index", "api"}
    assert {tuple(service["profiles"]) for service in SERVICES.values() if "profiles" in service} == {("milvus",)}
    volumes = [{volume.split(":")[0] for volume in SERVICES[name]["volumes"]} for name in APIS]
    assert not volumes[0] & volumes[1], "neither takes the other's index for its own"
    assert re.fullmatch(r"milvusdb/milvus:v\d+\.\d+\.\d+", SERVICES["milvus"]["image"]), "a pinned version"
    assert "9091/healthz" in SERVICES["milvus"]["healthcheck"]["test"][-1]
    for name in ("index-milvus", "api-milvus"):
        assert "HEREABOUTS_MILVUS_URI=http://milvus:19530" in SERVICES[name]["environment"]
        assert SERVICES[name]["depends_on"]["milvus"] == {"condition": "service_healthy"}
    both = [SERVICES[name]["command"] for name in ("index", "index-milvus")]
    assert both[1] == [*both[0], "--store", "milvus"]


@pytest.mark.parametrize("name", APIS)
def test_a_stop_waits_for_the_longest_request(name: str) -> None:
    grace = SERVICES[name]["stop_grace_period"]
    assert grace.endswith("s")
    assert int(grace[:-1]) > MAX_DEADLINE_MS / 1000 + CLOSING_S
    assert argument_of("STOPSIGNAL") == "SIGTERM"
    assert command_of("CMD"), "through a shell the signal would not reach the service"


def test_what_is_compiled_with_the_image_is_where_it_may_be_written(tmp_path) -> None:
    start = (ROOT / "docker/start.sh").read_text()
    compiled, cache = tmp_path / "compiled", tmp_path / "cache"
    compiled.mkdir()
    (compiled / "some.nbc").write_text("code")
    script = tmp_path / "start"
    script.write_text(start.replace("/opt/numba", str(compiled)))
    words, environ = ["sh", str(script), "sh", "-c", "exit 7"], os.environ | {"NUMBA_CACHE_DIR": str(cache)}
    assert subprocess.run(words, env=environ, check=False).returncode == 7
    assert (cache / "some.nbc").read_text() == "code"
    (cache / "some.nbc").write_text("newer")
    assert subprocess.run(words, env=environ, check=False).returncode == 7
    assert (cache / "some.nbc").read_text() == "newer", "another start takes nothing away"
    nowhere = environ | {"NUMBA_CACHE_DIR": "/proc/numba"}
    refused = subprocess.run(words, env=nowhere, capture_output=True, check=False)
    assert refused.returncode == 7, "it starts all the same"
    assert b"numba compiles again" in refused.stderr


def test_health_is_asked_for() -> None:
    assert "/readyz" in command_of("HEALTHCHECK")[-1]
    assert not any("healthcheck" in SERVICES[name] for name in APIS), "the image's own"


class Confined:
    """Runs commands as a user who may read everything and write one directory, with the image's variables."""

    def __init__(self, scratch: Path) -> None:
        self.scratch = scratch
        scratch.mkdir()
        os.chown(scratch, NOBODY, NOBODY)
        home = scratch.with_name("home")
        home.mkdir(mode=0o555)
        image = dict(pair.split("=", 1) for pair in shlex.split(argument_of("ENV")))
        own = {"TMPDIR": str(scratch), "HOME": str(home), "HEREABOUTS_JOBS_DIR": str(scratch / "jobs")}
        variables = {name: value.replace("/tmp/", f"{scratch}/") for name, value in image.items() if name != "PATH"}
        self.environ = variables | own | {"PATH": os.environ["PATH"], "HEREABOUTS_WORKERS": "1"}
        _copy_code(Path(variables["NUMBA_CACHE_DIR"]))
        self.cwd, self.log = home, scratch.with_name("said")

    def start(self, words: list[str], **variables: str) -> "subprocess.Popen[bytes]":
        """A process; what it says is in `said`."""
        user = [f"--reuid={NOBODY}", f"--regid={NOBODY}", "--clear-groups", "--no-new-privs"]
        caps = [f"--{kind}-caps=-all,+dac_read_search" for kind in ("inh", "ambient")]
        # Without the bit access(2), by which options are checked, takes no heed of capabilities.
        privileges = ["setpriv", *user, *caps, "--securebits=+no_setuid_fixup"]
        with self.log.open("wb") as log:
            return subprocess.Popen(
                [*privileges, *words], env=self.environ | variables, cwd=self.cwd, stdout=log, stderr=log
            )

    def run(self, words: list[str], **variables: str) -> int:
        """The exit status of a command."""
        return self.start(words, **variables).wait(120)

    def lines(self) -> list[dict[str, Any]]:
        """Return the lines that a service has logged."""
        return [json.loads(line) for line in self.log.read_text().splitlines(keepends=True) if line.endswith("\n")]


def _copy_code(cache: Path) -> None:
    """Put what was compiled here already where the image's start puts what was compiled with it."""
    for room in [*ROOT.glob("models/**/__pycache__"), *ROOT.glob("index/**/__pycache__")]:
        for code in room.glob("*/*/*.nb[ci]"):
            copy = cache / code.relative_to(room)
            copy.parent.mkdir(parents=True, exist_ok=True)
            with suppress(FileNotFoundError):  # exchanged by another test at this moment
                shutil.copy2(code, copy)
    for path in [cache, *cache.rglob("*")] if cache.exists() else []:
        os.chown(path, NOBODY, NOBODY)


@pytest.fixture
def confined(tmp_path):
    if os.geteuid() or shutil.which("setpriv") is None:
        pytest.skip("takes root and setpriv")
    confined = Confined(tmp_path / "scratch")
    if confined.run(["true"]):
        pytest.skip("setpriv may not set users and capabilities here")
    assert confined.run(["touch", str(confined.cwd / "file")]), "else this tests nothing"
    assert confined.run(["touch", str(confined.scratch / "file")]) == 0
    yield confined
    left = [entry.path for place in ANYBODYS for entry in os.scandir(place) if entry.stat().st_uid == NOBODY]
    assert left == []


@pytest.mark.slow
def test_the_service_answers_and_ends_with_one_writable_directory(confined, index_dir, weights_dir) -> None:
    words = run_here(command_of("CMD"))
    words[words.index("--index") + 1] = str(index_dir)
    words[words.index("--host") + 1] = "127.0.0.1"
    words[words.index("--port") + 1] = "0"
    process = confined.start(words, HEREABOUTS_WEIGHTS_DIR=str(weights_dir))
    try:
        wait_until(lambda: any(line["event"] == "page" for line in confined.lines()))
        [url] = [line["url"] for line in confined.lines() if line["event"] == "page"]
        health = run_here([word.replace("http://127.0.0.1:8000/", url) for word in command_of("HEALTHCHECK")])
        wait_until(lambda: is_ready(url.rstrip("/")), 300)  # numba may have to compile
        assert subprocess.run(health, capture_output=True, check=False).returncode == 0
        answer = httpx.post(f"{url}localize", json={"description": TEXT}, timeout=60)
        assert answer.status_code == 200, answer.text
        process.terminate()
        assert process.wait(60) == 0, confined.log.read_text()
        assert [line for line in confined.lines() if line["level"] != "info"] == []
    finally:
        process.kill()
        process.wait()


@pytest.mark.slow
def test_an_index_is_built_with_one_writable_directory(confined, osm_file, weights_dir) -> None:
    out = confined.scratch / "index"
    words = ["hereabouts", *SERVICES["index"]["command"][1:]]
    words[words.index("--map") + 1], words[words.index("--out") + 1] = str(osm_file), str(out)
    done = confined.run(run_here(words), HEREABOUTS_WEIGHTS_DIR=str(weights_dir))
    assert done == 0, confined.log.read_text()
    assert (out / "aliases.json").is_file()
