#!/bin/sh
# Installs the pinned torch: a wheel in wheels/ if there is one, else the build that TORCH_BACKEND names, else the
# package registry's (on Linux the CUDA build of several GB, which also runs on a CPU).
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
