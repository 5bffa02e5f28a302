"""Index versions without a model's work in them."""

import hashlib

from index.build.artifact import set_alias
from index.build.manifest import REQUIRED_FILES, FrameRecord, Manifest, write_manifest
from models.files import FileRecord


def write_version(directory):
    """Files that are what their manifest says, whatever that is."""
    directory.mkdir()
    for name in REQUIRED_FILES:
        (directory / name).write_text(name)
    files = {
        name: FileRecord(sha256=hashlib.sha256(name.encode()).hexdigest(), bytes=len(name))
        for name in sorted(REQUIRED_FILES)
    }
    manifest = Manifest(
        version=directory.name,
        created="2026-01-01T00:00:00+00:00",
        software="0",
        map_name="fakeville",
        map_sha256="ab" * 32,
        attribution="© nobody",
        frame=FrameRecord(frame_id="map", origin_lat=60.17, origin_lon=24.94, epsg=None),
        palette="basic",
        cell_size_m=30.0,
        grid_m=10.0,
        model="fake",
        model_fingerprint="ab" * 32,
        dim=8,
        cells=2,
        instances=3,
        files=files,
    )
    write_manifest(directory, manifest)


def write_index(root):
    """An index directory with v1, which is the default, and v2, which nothing names; it is returned."""
    root.mkdir()
    for version in ("v2", "v1"):
        write_version(root / version)
        set_alias(root, "default", version)
    return root
