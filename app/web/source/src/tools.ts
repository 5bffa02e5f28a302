// What a finger on the map can do besides moving it: drop a pin, or say where to look.

import type { Camera } from "./camera";
import type { Drag } from "./controls";
import type { Key } from "./language";
import type { State, Within } from "./state";

export type Tool = "describe" | "correct" | "near" | "circle" | "box";
type AreaTool = Exclude<Tool, "describe" | "correct">;
export type Area = { prior: State["prior"] } | { within: Within };

const USUAL = { near: 50, circle: 150, box: 150 }; // metres, where nothing was drawn
const LEAST = 3; // metres; less was a click

export const HINTS: Record<Exclude<Tool, "correct">, Key> = {
  describe: "hintDescribe",
  near: "hintNear",
  circle: "hintCircle",
  box: "hintBox",
};

/** An area as one draws it from a first place to a second. */
function areaOf(tool: AreaTool, from: [number, number], to: [number, number]): Area {
  const [wide, high] = [to[0] - from[0], to[1] - from[1]];
  const drawn = Math.hypot(wide, high);
  const size = drawn < LEAST ? USUAL[tool] : drawn;
  if (tool === "near") return { prior: { position: from, sigma_m: Math.round(size) } };
  if (tool === "circle") return { within: { circle: { center: from, radius_m: Math.round(size) } } };
  if (drawn < LEAST) return { within: { bbox: [from[0] - size, from[1] - size, from[0] + size, from[1] + size] } };
  return { within: { bbox: [Math.min(from[0], to[0]), Math.min(from[1], to[1]), Math.max(from[0], to[0]), Math.max(from[1], to[1])] } };
}

/** Draws an area with a finger; null above the horizon. */
export function draw(tool: AreaTool, camera: Camera, px: number, py: number, drawn: (area: Area, done: boolean) => void): Drag | null {
  const from = camera.ground(px, py);
  if (!from) return null;
  let to = from;
  return {
    move(mx, my) {
      to = camera.ground(mx, my) ?? to;
      drawn(areaOf(tool, from, to), false);
    },
    end() {
      drawn(areaOf(tool, from, to), true);
    },
  };
}
