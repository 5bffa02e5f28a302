// Candidates are cells, and neighbouring cells are one place to people.

import type { Answer, Candidate } from "./api";

const SAME = 30; // metres
const FITS = 0.25; // of the likeliest place's probability: from here on a place fits as well

export interface Place {
  letter: string;
  at: [number, number];
  probability: number;
  candidates: Candidate[];
  fits: boolean;
}

/** The candidates of an answer by place, likeliest first. */
export function placesOf(answer: Answer): Place[] {
  const places: Place[] = [];
  for (const candidate of answer.candidates) {
    const [x, y] = candidate.position;
    const same = places.find((place) => Math.hypot(place.at[0] - x, place.at[1] - y) <= SAME);
    if (same) {
      same.candidates.push(candidate);
      same.probability += candidate.probability;
    } else {
      places.push({ letter: "", at: [x, y], probability: candidate.probability, candidates: [candidate], fits: false });
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
