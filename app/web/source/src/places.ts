// Candidates are cells, and neighbouring cells are one place to people.

import type { Answer } from "./api";
import { LINE, type Box, type Scenery } from "./scenery";

const SAME = 30; // metres
const NEAR = 40; // metres: no street is farther from what is on it
const FITS = 0.25; // of the likeliest place's probability: from here on a place fits as well

export interface Place {
  letter: string;
  street: string | null;
  at: [number, number];
  probability: number;
  fits: boolean;
}

/** The candidates of an answer by place: the estimate's, then the others by probability. */
export function placesOf(answer: Answer, street: (at: [number, number]) => string | null): Place[] {
  const places: Place[] = [];
  for (const candidate of answer.candidates) {
    const [x, y] = candidate.position;
    const same = places.find((place) => Math.hypot(place.at[0] - x, place.at[1] - y) <= SAME);
    if (same) {
      same.probability += candidate.probability;
    } else {
      places.push({ letter: "", street: street([x, y]), at: [x, y], probability: candidate.probability, fits: false });
    }
  }
  share(answer, places);
  const [first, ...others] = places;
  others.sort((a, b) => b.probability - a.probability);
  const sorted = first ? [first, ...others] : [];
  const most = Math.max(0, ...sorted.map((place) => place.probability));
  sorted.forEach((place, n) => {
    place.letter = n < 26 ? String.fromCharCode(65 + n) : String(n + 1);
    place.fits = place.probability >= FITS * most;
  });
  return sorted;
}

/** Gives places what the heat map has round them: it knows of more cells than are listed. */
function share(answer: Answer, places: Place[]): void {
  const heat = answer.heat_map;
  if (!heat || heat.spacing_m > SAME || !places.length) return;
  for (const place of places) place.probability = 0;
  for (const [x, y, probability] of heat.points) {
    const away = places.map(({ at }) => Math.hypot(at[0] - x, at[1] - y));
    const nearest = away.indexOf(Math.min(...away));
    if (away[nearest] <= SAME) places[nearest].probability += probability;
  }
}

/** What to look at: the answer with its ring, or all places that fit. */
export function boxOf(answer: Answer, places: Place[]): Box | null {
  if (!answer.estimate) return null;
  const open = answer.status === "ambiguous";
  const fitting = open ? places.filter((place) => place.fits).map((place) => place.at) : [answer.estimate.position];
  return boxRound(fitting, open ? 60 : Math.max(60, 1.2 * answer.estimate.radius_m.p90));
}

export function boxRound(points: [number, number][], reach: number): Box {
  const [x, y] = [points.map((at) => at[0]), points.map((at) => at[1])];
  return { west: Math.min(...x) - reach, east: Math.max(...x) + reach, south: Math.min(...y) - reach, north: Math.max(...y) + reach };
}

/** The name of the nearest street. */
export function streetAt(sceneries: Scenery[], [x, y]: [number, number]): string | null {
  let [nearest, name]: [number, string | null] = [NEAR, null];
  for (const scenery of sceneries) {
    if (scenery.kind !== "shapes") continue;
    for (const shape of scenery.shapes) {
      if (shape.form !== LINE || !shape.name) continue;
      for (const path of shape.paths) {
        for (let n = 0; n + 3 < path.length; n += 2) {
          const away = fromLine(x - path[n], y - path[n + 1], path[n + 2] - path[n], path[n + 3] - path[n + 1]);
          if (away < nearest) [nearest, name] = [away, shape.name];
        }
      }
    }
  }
  return name;
}

/** From (x, y) to the line from (0, 0) to (u, v). */
function fromLine(x: number, y: number, u: number, v: number): number {
  const share = Math.max(0, Math.min(1, (x * u + y * v) / (u * u + v * v || 1)));
  return Math.hypot(x - share * u, y - share * v);
}
