"""Commands on the aliases of an index directory."""
# ruff: noqa: PLC0415

import re
from pathlib import Path
from typing import Annotated

import typer

from app.cli.options import INDEX_DIR, IndexDir
from models.errors import DataError, IndexBroken

AliasName = Annotated[str, typer.Argument(metavar="NAME", help="the alias, which requests pass as `index`")]

aliases = typer.Typer(help="List and change the aliases of an index directory.", no_args_is_help=True)


@aliases.command("list")
def list_aliases(index_dir: IndexDir = INDEX_DIR) -> None:
    """Print each alias with its version, then the versions without an alias, marked "-"."""
    from index.build.artifact import list_versions, read_aliases

    known, versions = read_aliases(index_dir), list_versions(index_dir)
    if not known.aliases and not versions:
        raise IndexBroken(f"no index in {index_dir}; give the directory that 'hereabouts index' wrote as --index")
    for alias, version in sorted(known.aliases.items()):
        typer.echo(f"{alias}\t{version}")
    for version in sorted(set(versions) - set(known.aliases.values())):
        typer.echo(f"-\t{version}")


@aliases.command("set")
def set_alias(
    name: AliasName,
    version: Annotated[str, typer.Argument(metavar="VERSION", help="a version in the index directory")],
    index_dir: IndexDir = INDEX_DIR,
) -> None:
    """Verify a version and point an alias to it. A version that was copied into the directory is registered first."""
    from index.build import artifact
    from index.build.manifest import NAME_PATTERN

    if not re.fullmatch(NAME_PATTERN, name):
        raise DataError(f"{name!r} is not a name for an alias; use letters, digits, '.', '_' and '-'")
    versions = artifact.list_versions(index_dir)
    if version not in versions:
        raise IndexBroken(f"no version {version} in {index_dir}; its versions are {', '.join(versions) or 'none'}")
    try:
        artifact.register(index_dir, version)
        artifact.set_alias(index_dir, name, version)
    except OSError as error:
        raise _not_written(index_dir, error) from error
    typer.echo(f"{name} names {version}; a running service switches as soon as it has opened that version")


@aliases.command("remove")
def remove_alias(name: AliasName, index_dir: IndexDir = INDEX_DIR) -> None:
    """Remove an alias but keep its version. The alias "default" cannot be removed, as requests use it by default."""
    from index.build import artifact

    if name == artifact.DEFAULT_ALIAS:
        raise DataError(f"{name} cannot be removed; let it name another version with 'hereabouts alias set'")
    try:
        artifact.remove_alias(index_dir, name)
    except OSError as error:
        raise _not_written(index_dir, error) from error
    typer.echo(f"{name} is removed; a running service stops serving it within a second")


def _not_written(index_dir: Path, error: OSError) -> DataError:
    return DataError(
        f"{index_dir} cannot be written: {error}; free some space, or run this as the owner of the directory"
    )
