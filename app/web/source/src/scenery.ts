// What a map looks like, as GET /maps/{name}/points sends it: shapes of geometry, or coloured points. Metres, x east, y north.

import { readTensors } from "./safetensors";

export const POINT = 0;
export const LINE = 1;
export const AREA = 2;

export interface Shape {
  label: string;
  form: number;
  base: number;
  top: number;
  width: number;
  name: string | null;
  source: string | null;
  paths: Float32Array[]; // x, y, x, y ...
  hole: boolean[];
}

export interface Place {
  x: number;
  y: number;
  name: string;
  kind: string;
}

export interface Shapes {
  kind: "shapes";
  labels: string[]; // what lies on top first
  shapes: Shape[];
  places: Place[];
  box: Box;
}

export interface Cloud {
  kind: "points";
  xyz: Float32Array;
  rgb: Uint8Array;
  box: Box;
}

export interface Box {
  west: number;
  south: number;
  east: number;
  north: number;
}

export type Scenery = Shapes | Cloud;

const UNIT = 0.1;
const GROUND = 0.15; // of a cloud's points are no higher than where one stands, about
const KINDS = ["node", "way", "relation"];

export function readScenery(buffer: ArrayBuffer): Scenery {
  const tensors = readTensors(buffer);
  return tensors.metadata.kind === "points" ? readCloud(tensors) : readShapes(tensors);
}

function readShapes(tensors: ReturnType<typeof readTensors>): Shapes {
  const labels: string[] = JSON.parse(tensors.metadata.labels);
  const names: Record<string, string> = JSON.parse(tensors.metadata.names);
  const places: [number, number, string, string][] = JSON.parse(tensors.metadata.places);
  const [label, form, base, top, width, paths, source, size, hole] = [
    "label", "form", "base", "top", "width", "paths", "source", "size", "hole",
  ].map((name) => tensors.get(name));
  const { values, box } = walked(tensors.get("steps"), 2);
  const shapes: Shape[] = [];
  for (let object = 0, path = 0, vertex = 0; object < label.length; object++) {
    const shape: Shape = {
      label: labels[label[object]],
      form: form[object],
      base: base[object] * UNIT,
      top: top[object] * UNIT,
      width: width[object] * UNIT,
      name: names[object] ?? null,
      source: source[object] < 0 ? null : `${KINDS[source[object] % 4]}/${Math.floor(source[object] / 4)}`,
      paths: [],
      hole: [],
    };
    for (const last = path + paths[object]; path < last; path++) {
      shape.paths.push(values.subarray(2 * vertex, 2 * (vertex + size[path])));
      shape.hole.push(hole[path] === 1);
      vertex += size[path];
    }
    shapes.push(shape);
  }
  return {
    kind: "shapes",
    labels,
    shapes,
    places: places.map(([x, y, name, kind]) => ({ x: x * UNIT, y: y * UNIT, name, kind })),
    box,
  };
}

function readCloud(tensors: ReturnType<typeof readTensors>): Cloud {
  const { values, box } = walked(tensors.get("steps"), 3);
  const heights = values.filter((_, n) => n % 3 === 2).sort();
  const ground = heights[Math.floor(GROUND * heights.length)] ?? 0;
  for (let n = 2; n < values.length; n += 3) values[n] -= ground; // answers are drawn at height 0
  return { kind: "points", xyz: values, rgb: tensors.get("rgb") as Uint8Array, box };
}

/** Steps of `width` numbers each as places in metres, and the box that holds them. */
function walked(steps: ArrayLike<number>, width: number): { values: Float32Array; box: Box } {
  const values = new Float32Array(steps.length);
  const at = [0, 0, 0];
  const low = [Infinity, Infinity];
  const high = [-Infinity, -Infinity];
  for (let n = 0; n < steps.length; n++) {
    const axis = n % width;
    at[axis] += steps[n];
    values[n] = at[axis] * UNIT;
    if (axis < 2) {
      low[axis] = Math.min(low[axis], values[n]);
      high[axis] = Math.max(high[axis], values[n]);
    }
  }
  if (!steps.length) low.fill(0), high.fill(0);
  return { values, box: { west: low[0], south: low[1], east: high[0], north: high[1] } };
}
