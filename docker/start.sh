#!/bin/sh
# Copies numba's cache from the image to where numba may write, then runs the command. On another kind of processor
# numba compiles again, which adds twenty seconds to the first start.
[ -d "$NUMBA_CACHE_DIR" ] || cp -r /opt/numba "$NUMBA_CACHE_DIR" || echo "start: cannot write $NUMBA_CACHE_DIR; numba compiles again" >&2
exec "$@"
