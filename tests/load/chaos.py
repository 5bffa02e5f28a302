"""Whether kills lose anything or leave it half done: run by `make chaos`, which says how many.

Kills builds of an index, `hereabouts alias set`, and a service that takes evaluations, each after a random share of the
time that it takes undisturbed. Then the service starts again: what was acknowledged has to be
there, what was not wholly or not at all, and no scrap of it. Prints a line of JSON an operation with the kills "before"
anything of it was on disk, "during" it, and "after" it was acknowledged. Ends with 1 at the first thing that is wrong.
"""

import argparse
import json
import math
import random
import sys
import tempfile
import traceback
from collections import Counter
from pathlib import Path

from tests.load.killed import OPERATIONS, Place
from tests.mould import Mould

LATEST = 1.2  # of the time that it takes; late moments are drawn more often, as writing comes last


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--kills", type=int, default=200)
    parser.add_argument("--seed", type=int, default=7)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        try:
            for counts in run(arguments.kills, arguments.seed, Path(scratch)):
                print(json.dumps(counts), flush=True)
        except Exception as wrong:
            traceback.print_exc()
            print(json.dumps({"wrong": str(wrong), "seed": arguments.seed}), flush=True)
            return 1
    return 0


def run(kills, seed, scratch):
    """Share some kills out over all operations; the counts of each, as they are done."""
    rng = random.Random(seed)
    with Mould(scratch) as mould:
        place = Place(mould, scratch / "index")
        for number, kind in enumerate(OPERATIONS):
            place.start()  # also before it is measured: a service that has just started takes longer
            yield {"operation": kind.__name__.lower(), **shake(kind(place), (kills + number) // len(OPERATIONS), rng)}
            place.end()


def shake(operation, kills, rng):
    """Kill an operation some times.

    Returns:
        How many kills came before anything of it was on disk, during it, and after it was acknowledged.
    """
    place, counts = operation.place, Counter(before=0, during=0, after=0)
    operation.prepare()
    operation.check(operation.do())
    for _ in range(kills):
        operation.prepare()
        before = place.state_on_disk()
        acknowledged = operation.do(LATEST * math.sqrt(rng.random()))
        place.end()
        counts["after" if acknowledged else "during" if place.state_on_disk() != before else "before"] += 1
        place.start()
        operation.check(acknowledged)
    return {"kills": kills, **counts, "takes_ms": round(1000 * operation.takes_s, 1)}


if __name__ == "__main__":
    sys.exit(main())
