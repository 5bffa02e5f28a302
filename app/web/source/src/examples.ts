// Descriptions that work on the map that is loaded: random places of it, described by it.

import { describe, Problem, type Described } from "./api";
import { LINE, type Scenery, type Shapes } from "./scenery";

const TRIES = 10; // places, until one can be described
const EDGE = 0.1; // of the map: what lies there has half of its surroundings

export async function examples(scenery: Scenery | undefined, amount: number): Promise<Described[]> {
  const found: Described[] = [];
  for (let n = 0; n < TRIES * amount && found.length < amount; n++) {
    const position = somewhere(scenery);
    if (!position) continue; // by bad luck: of a small map much is edge
    try {
      found.push(await describe(position));
    } catch (error) {
      if (!(error instanceof Problem && error.code === "invalid_request")) throw error; // else there is nothing to tell of
    }
  }
  return found;
}

/** A random place where people stand, not at the edge: on a street, or among the points. */
function somewhere(scenery: Scenery | undefined): [number, number] | null {
  if (!scenery) return null;
  const { west, south, east, north } = scenery.box;
  const [wide, high] = [EDGE * (east - west), EDGE * (north - south)];
  for (let n = 0; n < TRIES; n++) {
    const place = scenery.kind === "points" ? anyOf(scenery.xyz, 3) : onStreet(scenery);
    if (!place) return null;
    const [x, y] = place;
    if (x > west + wide && x < east - wide && y > south + high && y < north - high) return place;
  }
  return null;
}

function onStreet(scenery: Shapes): [number, number] | null {
  const streets = scenery.shapes.filter((shape) => shape.label === "road" && shape.form === LINE);
  const path = streets[Math.floor(Math.random() * streets.length)]?.paths[0];
  if (!path) return null;
  const n = 2 * Math.floor(Math.random() * (path.length / 2 - 1));
  const share = Math.random();
  return [path[n] + share * (path[n + 2] - path[n]), path[n + 1] + share * (path[n + 3] - path[n + 1])];
}

function anyOf(numbers: Float32Array, width: number): [number, number] {
  const n = width * Math.floor(Math.random() * (numbers.length / width));
  return [numbers[n], numbers[n + 1]];
}
