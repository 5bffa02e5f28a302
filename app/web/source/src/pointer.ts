// What a pointer on the map means: the work of a tool, or whatever stands under it.

import { fitOf } from "./answer";
import type { Camera } from "./camera";
import type { Drag, Picked } from "./controls";
import { PIN_HEIGHT, type Shown } from "./overlay";
import { draw, type Area, type Tool } from "./tools";

const CLOSE = 14; // pixels from the pointer to what it means

export interface Hand {
  readonly camera: Camera;
  readonly shown: Shown;
  readonly tool: Tool | null;
  describe(position: [number, number]): void;
  /** Puts the pin of a correction; `done` when it stays there. */
  pin(position: [number, number], done: boolean): void;
  drawn(area: Area, done: boolean): void;
  choose(place: number): void;
  light(mention: number | null): void;
}

export function pointer(hand: Hand): Picked {
  const areaFrom = (px: number, py: number) => {
    const { tool } = hand;
    return tool && tool !== "describe" && tool !== "correct" ? draw(tool, hand.camera, px, py, (area, done) => hand.drawn(area, done)) : null;
  };
  return {
    grab: (px, py) => pinDrag(hand, px, py) ?? areaFrom(px, py),
    click(px, py) {
      const at = hand.camera.ground(px, py);
      if (!at) return;
      if (hand.tool === "describe") hand.describe(at);
      else if (hand.tool === "correct") hand.pin(at, true);
      else if (hand.tool) areaFrom(px, py)?.end();
      else pick(hand, px, py);
    },
    hover: (px, py) => hand.light(mentionAt(hand, px, py)),
    leave: () => hand.light(null),
  };
}

/** Drags the pin of a correction by its point or its head. */
function pinDrag(hand: Hand, px: number, py: number): Drag | null {
  const { right } = hand.shown;
  const point = right && hand.camera.project(...right);
  if (!point || !(isNear(point, px, py) || isNear([point[0], point[1] - PIN_HEIGHT], px, py))) return null;
  const [dx, dy] = [point[0] - px, point[1] - py];
  return {
    move(mx, my) {
      const to = hand.camera.ground(mx + dx, my + dy);
      if (to) hand.pin(to, false);
    },
    end: () => hand.pin(hand.shown.right!, true),
  };
}

/** A place that fits is chosen; what was mentioned is lit up, for who has no mouse. */
function pick(hand: Hand, px: number, py: number): void {
  const { answer, places } = hand.shown;
  const near = places.findIndex(({ at }) => isNear(hand.camera.project(...at), px, py));
  if (near >= 0 && answer?.status === "ambiguous") hand.choose(near);
  else hand.light(mentionAt(hand, px, py));
}

function mentionAt({ camera, shown }: Hand, px: number, py: number): number | null {
  const evidence = shown.answer?.evidence ?? [];
  const near = evidence.findIndex((each) => each.at && fitOf(each) !== "none" && isNear(camera.project(...each.at), px, py));
  return near < 0 ? null : near;
}

function isNear(at: [number, number] | null, px: number, py: number): boolean {
  return at !== null && Math.hypot(at[0] - px, at[1] - py) <= CLOSE;
}
