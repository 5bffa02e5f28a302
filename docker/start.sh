#!/bin/sh
# Puts the machine code that was compiled with the image where numba may write, then becomes the command. What was
# compiled for another kind of processor is compiled anew: twenty seconds of the first start.
[ -d "$NUMBA_CACHE_DIR" ] || cp -r /opt/numba "$NUMBA_CACHE_DIR" || echo "start: no room in $NUMBA_CACHE_DIR; compiling instead" >&2
exec "$@"
