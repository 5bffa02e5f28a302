// What an answer adds to the map: heat, rings, places, what was mentioned, and where to look.

import type { Answer, Asked, Evidence } from "./api";
import type { Camera } from "./camera";
import type { Look } from "./look";
import type { Measurement } from "./report";
import type { Room } from "./names";
import type { Place } from "./places";
import { AREA, type Shape } from "./scenery";
import type { State } from "./state";
import { metres } from "./words";

type Pen = CanvasRenderingContext2D;
type Point = [number, number];

const LABEL = '600 12px system-ui, -apple-system, "Segoe UI", sans-serif';

export const PIN_HEIGHT = 26; // pixels from its point to the middle of its head

export interface Shown {
  said: string; // what the answer is to
  asked: Asked | null;
  answer: Answer | null;
  places: Place[];
  chosen: number; // of places
  mention: number | null; // of evidence, whose object is lit up
  pin: Point | null;
  right: Point | null; // where an operator says that it is
  measured: Measurement[];
}

/** Draws it all, and says whether there was anything; `objects` finds what has a source. */
export function paint(pen: Pen, camera: Camera, look: Look, taken: Room[], shown: Shown, state: State, objects: Map<string, Shape>): boolean {
  const { answer, places } = shown;
  area(pen, camera, look, state);
  if (answer && state.heat) heat(pen, camera, look, answer);
  if (answer && state.cells) cells(pen, camera, look, answer, taken);
  if (answer?.estimate) {
    answer.evidence.forEach((evidence, n) => object(pen, camera, colourOf(look, n), evidence, objects, n === shown.mention));
    if (answer.status === "ok") rings(pen, camera, look, answer.estimate);
    if (shown.mention !== null) line(pen, camera, look, answer.estimate.position, answer.evidence[shown.mention], shown.mention, taken);
  }
  if (answer?.status === "ambiguous" || shown.chosen > 0) {
    places.filter((place, n) => place.fits || n === shown.chosen).reverse().forEach((place) => marker(pen, camera, look, place, places.indexOf(place) === shown.chosen, taken));
  } else if (answer?.estimate) {
    dot(pen, camera, look.accent, answer.estimate.position, 8, taken);
  }
  if (shown.pin) pin(pen, camera, look, look.name, shown.pin, taken);
  if (shown.right) pin(pen, camera, look, look.accent, shown.right, taken);
  for (const each of shown.measured) error(pen, camera, look, each);
  return Boolean(answer || shown.pin || shown.right || shown.measured.length || state.prior || state.within);
}

function colourOf(look: Look, mention: number): string {
  return look.mentions[mention % look.mentions.length];
}

function trace(pen: Pen, camera: Camera, points: Iterable<Point>, height = 0): boolean {
  pen.beginPath();
  let begun = false;
  for (const [x, y] of points) {
    const at = camera.project(x, y, height);
    if (!at) return false;
    if (begun) pen.lineTo(...at);
    else pen.moveTo(...at);
    begun = true;
  }
  return begun;
}

function* circle([x, y]: Point, radius: number, from = 0, to = 2 * Math.PI): Generator<Point> {
  for (let n = 0; n <= 72; n++) {
    const angle = from + ((to - from) * n) / 72;
    yield [x + radius * Math.sin(angle), y + radius * Math.cos(angle)];
  }
}

function* box([west, south, east, north]: [number, number, number, number]): Generator<Point> {
  yield* [[west, south], [east, south], [east, north], [west, north], [west, south]] as Point[];
}

function area(pen: Pen, camera: Camera, look: Look, { prior, within }: State): void {
  pen.strokeStyle = look.name;
  pen.lineWidth = 2;
  if (within) {
    pen.setLineDash([]);
    if (trace(pen, camera, "circle" in within ? circle(within.circle.center, within.circle.radius_m) : box(within.bbox))) pen.stroke();
  }
  if (prior) {
    pen.setLineDash([6, 5]);
    for (const sigmas of [1, 2]) {
      pen.globalAlpha = 1.3 - sigmas / 2;
      if (trace(pen, camera, circle(prior.position, sigmas * prior.sigma_m))) pen.stroke();
    }
    pen.globalAlpha = 1;
    pen.setLineDash([]);
  }
}

function heat(pen: Pen, camera: Camera, look: Look, answer: Answer): void {
  const found = answer.heat_map;
  if (!found?.points.length) return;
  const most = found.points[0][2];
  const size = Math.max(3, (found.spacing_m / camera.metresAPixel) * 1.15);
  for (const [x, y, probability] of [...found.points].reverse()) {
    const share = Math.sqrt(probability / most);
    const at = share > 0.05 && camera.project(x, y);
    if (!at) continue;
    const ramp = look.heat[Math.min(look.heat.length - 1, Math.floor(share * look.heat.length))];
    pen.fillStyle = `rgb(${ramp.join()})`;
    pen.globalAlpha = Math.min(0.85, 0.25 + share);
    pen.fillRect(at[0] - size / 2, at[1] - size / 2, size, size);
  }
  pen.globalAlpha = 1;
}

function cells(pen: Pen, camera: Camera, look: Look, answer: Answer, taken: Room[]): void {
  pen.font = LABEL;
  pen.textAlign = "center";
  pen.textBaseline = "middle";
  for (const candidate of answer.candidates) {
    pen.strokeStyle = look.name;
    pen.lineWidth = candidate.rank === 1 ? 2 : 1;
    if (!trace(pen, camera, box(candidate.bbox))) continue;
    pen.stroke();
    const at = camera.project(candidate.bbox[0], candidate.bbox[3]);
    if (at) tag(pen, look, String(candidate.rank), at, taken);
  }
}

/** What a mention means, in the mention's colour. */
function object(pen: Pen, camera: Camera, colour: string, evidence: Evidence, objects: Map<string, Shape>, lit: boolean): void {
  const shape = evidence.source_id ? objects.get(evidence.source_id) : undefined;
  pen.fillStyle = pen.strokeStyle = colour;
  if (shape && shape.paths[0]?.length > 2) {
    for (const [n, path] of shape.paths.entries()) {
      if (shape.hole[n] || !trace(pen, camera, pairs(path), shape.top)) continue;
      pen.globalAlpha = lit ? 0.55 : 0.28;
      if (shape.form === AREA) pen.fill();
      pen.globalAlpha = lit ? 1 : 0.75;
      pen.lineWidth = lit ? 3 : 1.5;
      pen.stroke();
    }
    pen.globalAlpha = 1;
  }
  const at = evidence.at && camera.project(...evidence.at);
  if (!at) return;
  pen.beginPath();
  pen.arc(at[0], at[1], lit ? 7 : 4.5, 0, 2 * Math.PI);
  pen.fill();
  pen.strokeStyle = "#fff";
  pen.lineWidth = 1.5;
  pen.stroke();
}

function* pairs(path: Float32Array): Generator<Point> {
  for (let n = 0; n + 1 < path.length; n += 2) yield [path[n], path[n + 1]];
}

function line(pen: Pen, camera: Camera, look: Look, from: Point, evidence: Evidence, mention: number, taken: Room[]): void {
  const [a, b] = [camera.project(...from), evidence.at && camera.project(...evidence.at)];
  if (!a || !b) return;
  pen.strokeStyle = colourOf(look, mention);
  pen.lineWidth = 1.5;
  pen.beginPath();
  pen.moveTo(...a);
  pen.lineTo(...b);
  pen.stroke();
  const away = evidence.away_m ?? Math.hypot(evidence.at![0] - from[0], evidence.at![1] - from[1]);
  tag(pen, look, [evidence.name && `\u2068${evidence.name}\u2069`, metres(away)].filter(Boolean).join(" · "), [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2 - 14], taken);
}

function rings(pen: Pen, camera: Camera, look: Look, estimate: NonNullable<Answer["estimate"]>): void {
  const { position, radius_m, heading } = estimate;
  pen.fillStyle = pen.strokeStyle = look.accent;
  if (heading) {
    const [middle, half] = [(heading.mean_deg * Math.PI) / 180, (Math.min(90, Math.max(8, heading.spread_deg)) * Math.PI) / 180];
    const reach = Math.max(28 * camera.metresAPixel, 1.6 * radius_m.p50);
    pen.globalAlpha = 0.3;
    if (trace(pen, camera, [position, ...circle(position, reach, middle - half, middle + half)])) pen.fill();
  }
  pen.globalAlpha = 0.25;
  if (trace(pen, camera, circle(position, radius_m.p50))) pen.fill();
  pen.globalAlpha = 1;
  pen.lineWidth = 1.75;
  if (trace(pen, camera, circle(position, radius_m.p90))) pen.stroke();
}

function dot(pen: Pen, camera: Camera, colour: string, place: Point, radius: number, taken: Room[]): void {
  const at = camera.project(...place);
  if (!at) return;
  pen.beginPath();
  pen.arc(at[0], at[1], radius, 0, 2 * Math.PI);
  pen.fillStyle = colour;
  pen.fill();
  pen.lineWidth = 2.5;
  pen.strokeStyle = "#fff";
  pen.stroke();
  taken.push([at[0] - radius, at[1] - radius, at[0] + radius, at[1] + radius]);
}

function marker(pen: Pen, camera: Camera, look: Look, place: Place, chosen: boolean, taken: Room[]): void {
  dot(pen, camera, chosen ? look.accent : look.name, place.at, 12, taken);
  const at = camera.project(...place.at);
  if (!at) return;
  pen.font = LABEL;
  pen.textAlign = "center";
  pen.textBaseline = "middle";
  pen.fillStyle = chosen ? "#fff" : look.halo;
  pen.fillText(place.letter, at[0], at[1] + 0.5);
}

function pin(pen: Pen, camera: Camera, look: Look, colour: string, place: Point, taken: Room[]): void {
  const at = camera.project(...place);
  if (!at) return;
  pen.strokeStyle = colour;
  pen.lineWidth = 3;
  pen.beginPath();
  pen.moveTo(...at);
  pen.lineTo(at[0], at[1] - 22);
  pen.stroke();
  pen.beginPath();
  pen.arc(at[0], at[1] - PIN_HEIGHT, 7, 0, 2 * Math.PI);
  pen.fillStyle = colour;
  pen.fill();
  pen.strokeStyle = look.halo;
  pen.lineWidth = 2;
  pen.stroke();
  taken.push([at[0] - 8, at[1] - 34, at[0] + 8, at[1]]);
}

/** A query of an evaluation: from where it was said to where it was put. */
function error(pen: Pen, camera: Camera, look: Look, { truth, estimate, error_m }: Measurement): void {
  const [a, b] = [camera.project(...truth), estimate && camera.project(...estimate)];
  if (!a) return;
  const band = error_m === null || error_m > 15 ? 2 : error_m > 5 ? 1 : 0;
  pen.fillStyle = pen.strokeStyle = [colourOf(look, 2), colourOf(look, 4), look.accent][band];
  if (b) {
    pen.lineWidth = 1;
    pen.globalAlpha = 0.5;
    pen.beginPath();
    pen.moveTo(...a);
    pen.lineTo(...b);
    pen.stroke();
    pen.globalAlpha = 1;
  }
  pen.beginPath();
  if (band === 2) pen.rect(a[0] - 3.5, a[1] - 3.5, 7, 7);
  else pen.arc(a[0], a[1], band ? 4 : 3, 0, 2 * Math.PI);
  pen.fill();
}

function tag(pen: Pen, look: Look, text: string, [x, y]: Point, taken: Room[]): void {
  pen.font = LABEL;
  pen.textAlign = "center";
  pen.textBaseline = "middle";
  const half = pen.measureText(text).width / 2 + 6;
  pen.fillStyle = look.halo;
  pen.beginPath();
  pen.roundRect(x - half, y - 10, 2 * half, 20, 6);
  pen.fill();
  pen.fillStyle = look.name;
  pen.fillText(text, x, y + 0.5);
  taken.push([x - half, y - 10, x + half, y + 10]);
}
