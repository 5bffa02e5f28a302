// Descriptions that work on the map that is loaded: random places of it, described by the service, which writes English,
// or in another language by their street and two names nearby.

import { describe, Problem, type Described } from "./api";
import { language, t } from "./language";
import { LINE, type Scenery, type Shapes } from "./scenery";

const TRIES = 10; // places, until one can be described
const NAMED_TRIES = 200; // places, until one has enough names nearby
const EDGE = 0.1; // of the map: what lies there has half of its surroundings
const NEAR = 30; // metres from a place to what is named beside it

export type Example = Pick<Described, "description" | "place">;
type Spot = { at: [number, number]; street: string | null };

export async function examples(scenery: Scenery | undefined, amount: number): Promise<Example[]> {
  const found: Example[] = [];
  const named = language === "en" ? 0 : NAMED_TRIES;
  for (let n = 0; n < named + TRIES * amount && found.length < amount; n++) {
    const spot = somewhere(scenery);
    if (!spot) continue; // by bad luck: of a small map much is edge
    const example = n < named ? byNames(scenery!, spot) : await described(spot);
    if (example) found.push(example);
  }
  return found;
}

async function described(spot: Spot): Promise<Example | null> {
  try {
    return await describe(spot.at);
  } catch (error) {
    if (!(error instanceof Problem && error.code === "invalid_request")) throw error; // else there is nothing to tell of
    return null;
  }
}

/** A street and two names near a place on it; null if the map lacks them. */
function byNames(map: Scenery, { at, street }: Spot): Example | null {
  if (map.kind !== "shapes" || !street) return null;
  const away = new Map<string, number>();
  for (const { name, x, y } of map.places) away.set(name, Math.min(away.get(name) ?? Infinity, Math.hypot(x - at[0], y - at[1])));
  const near = [...away].filter(([name, metres]) => name !== street && metres < NEAR).sort((a, b) => a[1] - b[1]);
  if (near.length < 2) return null;
  return { description: t("example", { street, first: near[0][0], second: near[1][0] }), place: street };
}

/** A random place where people stand, not at the edge: on a street, or among the points. */
function somewhere(scenery: Scenery | undefined): Spot | null {
  if (!scenery) return null;
  const { west, south, east, north } = scenery.box;
  const [wide, high] = [EDGE * (east - west), EDGE * (north - south)];
  for (let n = 0; n < TRIES; n++) {
    const spot = scenery.kind === "points" ? anyOf(scenery.xyz, 3) : onStreet(scenery);
    if (!spot) return null;
    const [x, y] = spot.at;
    if (x > west + wide && x < east - wide && y > south + high && y < north - high) return spot;
  }
  return null;
}

function onStreet(scenery: Shapes): Spot | null {
  const streets = scenery.shapes.filter((shape) => shape.label === "road" && shape.form === LINE);
  const shape = streets[Math.floor(Math.random() * streets.length)];
  const path = shape?.paths[0];
  if (!path) return null;
  const n = 2 * Math.floor(Math.random() * (path.length / 2 - 1));
  const share = Math.random();
  return { at: [path[n] + share * (path[n + 2] - path[n]), path[n + 1] + share * (path[n + 3] - path[n + 1])], street: shape.name };
}

function anyOf(numbers: Float32Array, width: number): Spot {
  const n = width * Math.floor(Math.random() * (numbers.length / width));
  return { at: [numbers[n], numbers[n + 1]], street: null };
}
