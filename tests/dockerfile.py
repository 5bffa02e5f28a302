"""The last stage of docker/Dockerfile."""

import json
import re
from pathlib import Path

DOCKERFILE = Path(__file__).parent.parent / "docker/Dockerfile"


def instructions() -> list[tuple[str, str]]:
    """Return the instructions in order, each with its argument."""
    text = DOCKERFILE.read_text().replace("\\\n", " ")
    lines = [line.split(maxsplit=1) for line in text.splitlines() if line and not line.startswith("#")]
    last = max(number for number, (name, _) in enumerate(lines) if name == "FROM")
    return [(name, argument) for name, argument in lines[last:]]


def argument_of(instruction: str) -> str:
    """Return the argument that an instruction has the last time."""
    return [argument for name, argument in instructions() if name == instruction][-1]


def command_of(instruction: str) -> list[str]:
    """Return the words of CMD, ENTRYPOINT or HEALTHCHECK, which have to be in JSON form."""
    argument = argument_of(instruction)
    words: list[str] = json.loads(argument[argument.index("[") :])
    return words


def option(words: list[str], name: str) -> str:
    """Return the value of an option of a command."""
    return words[words.index(name) + 1]


def user_id() -> int:
    """Return the number of the user that the image creates and runs as."""
    user = argument_of("USER")
    [created] = [argument for name, argument in instructions() if name == "RUN" and f" {user} " in f"{argument} "]
    number = re.search(r"useradd .*--uid (\d+)", created)
    assert number, "the user has a number, by which volumes and clusters know it"
    return int(number[1])
