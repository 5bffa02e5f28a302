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
