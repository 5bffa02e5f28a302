// The places of an answer, lettered as people see them.

import type { Answer } from "./api";
import type { Box } from "./scenery";

const FITS = 0.25; // of the likeliest place's probability: from here on a place fits as well

export interface Place {
  letter: string;
  name: string | null; // in words
  at: [number, number];
  probability: number;
  fits: boolean;
  supports: string[];
  contradicts: string[];
}

/** The places of an answer, likeliest first. */
export function placesOf(answer: Answer): Place[] {
  const most = Math.max(0, ...answer.places.map((place) => place.probability));
  return answer.places.map((place, n) => ({
    letter: String.fromCharCode(65 + n),
    name: place.place ?? null,
    at: place.position,
    probability: place.probability,
    fits: place.probability >= FITS * most,
    supports: place.supports ?? [],
    contradicts: place.contradicts ?? [],
  }));
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
