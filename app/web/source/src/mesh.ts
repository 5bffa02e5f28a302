// Shapes as triangles.

import { ShapeUtils, Vector2 } from "three";
import { AREA, type Shape } from "./scenery";

/** Triangles under way: positions, and a shade a vertex that colours are multiplied with. */
export class Triangles {
  readonly positions: number[] = [];
  readonly shades: number[] = [];
  readonly index: number[] = [];

  vertex(x: number, y: number, z: number, shade = 1): number {
    this.positions.push(x, y, z);
    this.shades.push(shade);
    return this.positions.length / 3 - 1;
  }

  quad(a: number, b: number, c: number, d: number): void {
    this.index.push(a, b, c, a, c, d);
  }
}

const LIGHT_FROM = [-0.55, -0.83]; // south-west, as seen in the plane

/** The polygons of an area: an outer ring and its holes. */
export function polygons(shape: Shape): Float32Array[][] {
  const found: Float32Array[][] = [];
  shape.paths.forEach((path, n) => (shape.hole[n] ? found[found.length - 1]?.push(path) : found.push([path])));
  return found;
}

export function fill(out: Triangles, shape: Shape, z: number, shade = 1): void {
  for (const rings of polygons(shape)) {
    const corners = rings.map((ring) => {
      const points: Vector2[] = [];
      for (let n = 0; n < ring.length - 2; n += 2) points.push(new Vector2(ring[n], ring[n + 1])); // the last is the first
      return points;
    });
    if (corners[0].length < 3) continue;
    const first = out.positions.length / 3;
    for (const point of corners.flat()) out.vertex(point.x, point.y, z, shade);
    const all = corners.flat();
    for (const [a, b, c] of ShapeUtils.triangulateShape(corners[0], corners.slice(1))) {
      const turned = ShapeUtils.area([all[a], all[b], all[c]]) < 0; // its front is up
      out.index.push(first + a, first + (turned ? c : b), first + (turned ? b : c));
    }
  }
}

/** A shape as seen from afar: without the corners that are less than some metres from the one before, and what is smaller. */
export function coarser(shape: Shape, metres: number): Shape {
  const paths = shape.paths.map((path) => thinned(path, metres));
  const kept = paths.map((path) => path.length >= (shape.form === AREA ? 8 : 4)); // a ring ends where it began
  if (shape.form === AREA && !kept[0]) return { ...shape, paths: [], hole: [] };
  return { ...shape, paths: paths.filter((_, n) => kept[n]), hole: shape.hole.filter((_, n) => kept[n]) };
}

function thinned(path: Float32Array, metres: number): Float32Array {
  const kept: number[] = [];
  for (let n = 0; n < path.length; n += 2) {
    const [x, y] = [path[n], path[n + 1]];
    const isEnd = n === 0 || n === path.length - 2;
    if (isEnd || Math.hypot(x - kept[kept.length - 2], y - kept[kept.length - 1]) >= metres) kept.push(x, y);
  }
  return new Float32Array(kept);
}

/** Walls along every path of a shape; those of an area have their fronts outside. */
export function raise(out: Triangles, shape: Shape, base: number, top: number): void {
  shape.paths.forEach((path, ring) => {
    const turned = shape.form === AREA && turns(path) < 0 !== shape.hole[ring];
    for (let n = 0; n + 3 < path.length; n += 2) {
      const [x, y, u, v] = path.subarray(n, n + 4);
      const length = Math.hypot(u - x, v - y) || 1;
      const lit = Math.abs(((v - y) * LIGHT_FROM[0] - (u - x) * LIGHT_FROM[1]) / length);
      const shade = 0.8 + 0.12 * lit;
      const [a, b] = [out.vertex(x, y, base, shade * 0.94), out.vertex(u, v, base, shade * 0.94)];
      const [c, d] = [out.vertex(u, v, top, shade), out.vertex(x, y, top, shade)];
      if (turned) out.quad(d, c, b, a);
      else out.quad(a, b, c, d);
    }
  });
}

/** Twice the area in a ring, negative if it runs clockwise. */
function turns(ring: Float32Array): number {
  let sum = 0;
  for (let n = 0; n + 3 < ring.length; n += 2) sum += ring[n] * ring[n + 3] - ring[n + 2] * ring[n + 1];
  return sum;
}

/** A strip along every path of a shape, as wide as it says. */
export function widen(out: Triangles, shape: Shape, z: number): void {
  const half = Math.max(0.6, shape.width / 2);
  for (const path of shape.paths) {
    const count = path.length / 2;
    if (count < 2) continue;
    let [left, right] = [-1, -1];
    for (let n = 0; n < count; n++) {
      const [x, y] = [path[2 * n], path[2 * n + 1]];
      const [dx, dy] = along(path, Math.max(0, n - 1), Math.min(count - 1, n + 1));
      const [ax, ay] = n > 0 ? along(path, n - 1, n) : [dx, dy];
      const stretch = half / Math.max(0.5, ax * dx + ay * dy); // a corner is as wide as the street
      const pair = [out.vertex(x - dy * stretch, y + dx * stretch, z), out.vertex(x + dy * stretch, y - dx * stretch, z)];
      if (n > 0) out.quad(left, right, pair[1], pair[0]);
      [left, right] = pair;
    }
  }
}

function along(path: Float32Array, from: number, to: number): [number, number] {
  const [dx, dy] = [path[2 * to] - path[2 * from], path[2 * to + 1] - path[2 * from + 1]];
  const length = Math.hypot(dx, dy) || 1;
  return [dx / length, dy / length];
}
