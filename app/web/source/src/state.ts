// What the page was asked, in the URL's fragment: it can be shared, and no server ever gets it.

import type { Pose } from "./camera";

export type Within = { circle: { center: [number, number]; radius_m: number } } | { bbox: [number, number, number, number] };

export interface State {
  said: string;
  prior: { position: [number, number]; sigma_m: number } | null;
  within: Within | null;
  answers: { question: string; choice: string }[];
  topK: number;
  heat: boolean;
  cells: boolean;
  pose: Pose | null;
}

const USUAL_K = 5;
const MOST_ANSWERS = 8; // as the service has it

export function read(fragment: string): State {
  const given = new URLSearchParams(fragment.replace(/^#/, ""));
  const numbers = (name: string, amount: number): number[] | null => {
    const values = (given.get(name) ?? "").split(",").map((part) => (part.trim() ? Number(part) : NaN));
    return given.has(name) && values.length === amount && values.every(Number.isFinite) ? values : null;
  };
  const [prior, circle, box, at] = [numbers("near", 3), numbers("circle", 3), numbers("box", 4), numbers("at", 5)];
  return {
    said: [...(given.get("q") ?? "")].slice(0, 4000).join(""),
    prior: prior && prior[2] > 0 ? { position: [prior[0], prior[1]], sigma_m: prior[2] } : null,
    within: circle && circle[2] > 0
      ? { circle: { center: [circle[0], circle[1]], radius_m: circle[2] } }
      : box && { bbox: box as [number, number, number, number] },
    answers: answersOf(given.getAll("a")),
    topK: Math.min(40, Math.max(1, Math.round(Number(given.get("k")) || USUAL_K))),
    heat: given.has("heat"),
    cells: given.has("cells"),
    pose: at && { x: at[0], y: at[1], distance: at[2], pitch: at[3], bearing: at[4] },
  };
}

/** Question=choice each; of two to one question the last. */
function answersOf(given: string[]): State["answers"] {
  const found = new Map<string, string>();
  for (const answer of given) {
    const cut = answer.indexOf("="); // a name may have another
    if (cut > 0) found.set(answer.slice(0, cut), answer.slice(cut + 1));
  }
  return [...found].slice(0, MOST_ANSWERS).map(([question, choice]) => ({ question, choice }));
}

export function write(state: State): string {
  const given = new URLSearchParams();
  if (state.said) given.set("q", state.said);
  if (state.prior) given.set("near", [...state.prior.position, state.prior.sigma_m].map(short).join());
  if (state.within && "circle" in state.within) given.set("circle", [...state.within.circle.center, state.within.circle.radius_m].map(short).join());
  if (state.within && "bbox" in state.within) given.set("box", state.within.bbox.map(short).join());
  for (const { question, choice } of state.answers) given.append("a", `${question}=${choice}`);
  if (state.topK !== USUAL_K) given.set("k", String(state.topK));
  if (state.heat) given.set("heat", "1");
  if (state.cells) given.set("cells", "1");
  const pose = state.pose;
  if (pose) given.set("at", [short(pose.x), short(pose.y), short(pose.distance), pose.pitch.toFixed(3), pose.bearing.toFixed(3)].join());
  const text = given.toString();
  return text && `#${text}`;
}

function short(metres: number): string {
  return String(Math.round(10 * metres) / 10);
}
