#!/bin/sh
# Installs the pinned torch: from wheels/ if one lies there, else the build that TORCH_BACKEND names, else
# whatever the package registry has (on Linux that is the CUDA build, several GB, which runs on a CPU too).
set -eu
backend=$1
pin=$(grep '^torch==' constraints.txt)
if ls wheels/torch-*.whl >/dev/null 2>&1; then
    pip install wheels/torch-*.whl
elif pip install uv && uv pip install --torch-backend "$backend" "$pin"; then
    echo "torch: the $backend build"
else
    echo "torch: the $backend build cannot be reached; taking the registry's, which is large" >&2
    pip install "$pin"
fi
