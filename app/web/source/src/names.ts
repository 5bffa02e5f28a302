// Names on the map: streets along their lines, the rest at a point; what would overlap is left out.

import type { Camera } from "./camera";
import type { Look } from "./look";
import { LINE, type Shapes } from "./scenery";

const STREET_FROM = 3000; // metres of distance from which names of streets are written, and of everything else
const PLACE_FROM = 520;
const GREEN_FROM = 2200;
const HALO = 3; // pixels round a name
const APART = 260; // metres between two writings of one street
const FONT = '500 12px system-ui, -apple-system, "Segoe UI", sans-serif';
const SMALL = '11px system-ui, -apple-system, "Segoe UI", sans-serif';
const STREETS = new Set(["road", "footpath", "square", "driveway"]);
const GREENS = new Set(["park", "water", "square", "market place"]);

/** A name as it is drawn, made once: text with a halo is slow. */
interface Sprite {
  canvas: HTMLCanvasElement;
  wide: number; // pixels of the page
  high: number;
}

interface Name {
  text: string;
  x: number;
  y: number;
  angle: number | null; // of a street, in the plane
  length: number; // metres that a street has for it
  from: number;
  sprite?: Sprite;
}

export type Room = [number, number, number, number]; // left, top, right, bottom

export class Names {
  private readonly names: Name[] = [];

  constructor(map: Shapes) {
    const streets = new Map<string, Name[]>();
    for (const shape of map.shapes) {
      if (!shape.name) continue;
      if (shape.form === LINE && STREETS.has(shape.label)) {
        for (const path of shape.paths) {
          const name = along(shape.name, path);
          if (name) streets.set(shape.name, [...(streets.get(shape.name) ?? []), name]);
        }
      } else if (GREENS.has(shape.label)) {
        this.names.push({ text: shape.name, ...middle(shape.paths[0]), angle: null, length: 0, from: GREEN_FROM });
      }
    }
    for (const all of streets.values()) {
      const kept: Name[] = [];
      for (const name of all.sort((a, b) => b.length - a.length)) {
        if (kept.every((other) => Math.hypot(other.x - name.x, other.y - name.y) > APART)) kept.push(name);
      }
      this.names.push(...kept);
    }
    this.names.sort((a, b) => b.length - a.length);
    for (const place of map.places) this.names.push({ text: place.name, x: place.x, y: place.y, angle: null, length: 0, from: PLACE_FROM });
  }

  /** Says whether there was a name to draw. */
  draw(pen: CanvasRenderingContext2D, camera: Camera, look: Look, taken: Room[]): boolean {
    let drawn = false;
    for (const name of this.names) {
      if (camera.pose.distance > name.from) continue;
      const at = camera.project(name.x, name.y);
      if (!at || at[0] < 0 || at[1] < 0 || at[0] > camera.width || at[1] > camera.height) continue;
      const sprite = (name.sprite ??= spriteOf(name, look));
      const width = sprite.wide - 2 * HALO;
      let turn = 0;
      if (name.angle !== null) {
        const ahead = camera.project(name.x + Math.cos(name.angle), name.y + Math.sin(name.angle));
        if (!ahead) continue;
        const [dx, dy] = [ahead[0] - at[0], ahead[1] - at[1]];
        if (width > 1.1 * name.length * Math.hypot(dx, dy)) continue;
        turn = Math.atan(dy / (dx || 1e-6));
      }
      const [wide, high] = [
        (Math.abs(Math.cos(turn)) * width + Math.abs(Math.sin(turn)) * 14) / 2 + 4,
        (Math.abs(Math.sin(turn)) * width + Math.abs(Math.cos(turn)) * 14) / 2 + 4,
      ];
      const room: Room = [at[0] - wide, at[1] - high, at[0] + wide, at[1] + high];
      if (taken.some((other) => overlap(room, other))) continue;
      taken.push(room);
      drawn = true;
      pen.save();
      if (turn) pen.translate(...at);
      else pen.translate(Math.round(at[0] - sprite.wide / 2) + sprite.wide / 2, Math.round(at[1])); // sharp
      pen.rotate(turn);
      pen.drawImage(sprite.canvas, -sprite.wide / 2, -sprite.high / 2, sprite.wide, sprite.high);
      pen.restore();
    }
    return drawn;
  }
}

function spriteOf(name: Name, look: Look): Sprite {
  const canvas = document.createElement("canvas");
  const pen = canvas.getContext("2d")!;
  const ratio = Math.min(2, devicePixelRatio);
  const font = name.angle === null && name.from === PLACE_FROM ? SMALL : FONT;
  pen.font = font;
  const [wide, high] = [Math.ceil(pen.measureText(name.text).width) + 2 * HALO, 18 + 2 * HALO];
  [canvas.width, canvas.height] = [wide * ratio, high * ratio];
  pen.scale(ratio, ratio);
  Object.assign(pen, { font, textAlign: "center", textBaseline: "middle", lineJoin: "round", lineWidth: 3, strokeStyle: look.halo, fillStyle: look.name });
  pen.strokeText(name.text, wide / 2, high / 2);
  pen.fillText(name.text, wide / 2, high / 2);
  return { canvas, wide, high };
}

function overlap(a: Room, b: Room): boolean {
  return a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3];
}

/** A name at the middle of a line, as the line runs there. */
function along(text: string, path: Float32Array): Name | null {
  let length = 0;
  const parts: number[] = [];
  for (let n = 0; n + 3 < path.length; n += 2) parts.push(Math.hypot(path[n + 2] - path[n], path[n + 3] - path[n + 1]));
  for (const part of parts) length += part;
  let half = length / 2;
  for (let n = 0; n < parts.length; n++) {
    if (half > parts[n]) {
      half -= parts[n];
      continue;
    }
    const [x, y, u, v] = path.subarray(2 * n, 2 * n + 4);
    const share = half / (parts[n] || 1);
    return { text, x: x + share * (u - x), y: y + share * (v - y), angle: Math.atan2(v - y, u - x), length, from: STREET_FROM };
  }
  return null;
}

function middle(path: Float32Array): { x: number; y: number } {
  const box = [Infinity, Infinity, -Infinity, -Infinity];
  for (let n = 0; n < path.length; n += 2) {
    box[0] = Math.min(box[0], path[n]);
    box[1] = Math.min(box[1], path[n + 1]);
    box[2] = Math.max(box[2], path[n]);
    box[3] = Math.max(box[3], path[n + 1]);
  }
  return { x: (box[0] + box[2]) / 2, y: (box[1] + box[3]) / 2 };
}
