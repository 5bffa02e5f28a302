// Descriptions that work on the map that is loaded: random places of it, described by it.

import { describe, type Described } from "./api";
import { AREA, LINE, type Scenery } from "./scenery";

const TRIES = 6; // places, until one can be described

export async function examples(scenery: Scenery | undefined, amount: number): Promise<Described[]> {
  const found: Described[] = [];
  for (let n = 0; n < TRIES * amount && found.length < amount; n++) {
    const position = somewhere(scenery);
    if (!position) break;
    const described = await describe(position).catch(() => null);
    if (described) found.push(described);
  }
  return found;
}

/** A random place where people stand: on a street, or among the points. */
function somewhere(scenery: Scenery | undefined): [number, number] | null {
  if (!scenery) return null;
  if (scenery.kind === "points") {
    const n = 3 * Math.floor((Math.random() * scenery.xyz.length) / 3);
    return [scenery.xyz[n], scenery.xyz[n + 1]];
  }
  const streets = scenery.shapes.filter((shape) => shape.label === "road" && shape.form !== AREA && shape.name);
  const among = streets.length ? streets : scenery.shapes.filter((shape) => shape.form === LINE);
  if (!among.length) return null;
  const path = among[Math.floor(Math.random() * among.length)].paths[0];
  const n = 2 * Math.floor((Math.random() * path.length) / 2);
  return [path[n], path[n + 1]];
}

