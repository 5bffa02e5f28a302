// Moves the map with a mouse, with fingers and with keys.

import type { Camera } from "./camera";

const CLICK = 4; // pixels that a click may slip

/** What follows a finger or a mouse instead of the map. */
export interface Drag {
  move(px: number, py: number): void;
  end(): void;
}

export interface Picked {
  /** Takes a drag that begins here; null leaves it to the map. */
  grab(px: number, py: number): Drag | null;
  click(px: number, py: number): void;
  hover(px: number, py: number): void;
  leave(): void;
}

export function control(surface: HTMLElement, camera: Camera, picked: Picked): void {
  const fingers = new Map<number, [number, number]>();
  let [moved, turning] = [0, false];
  let drag: Drag | null = null;

  const spread = () => {
    const [a, b] = [...fingers.values()];
    return { middle: [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2], apart: Math.hypot(a[0] - b[0], a[1] - b[1]), angle: Math.atan2(b[1] - a[1], b[0] - a[0]) };
  };

  surface.addEventListener("pointerdown", (event) => {
    surface.setPointerCapture(event.pointerId);
    if (!fingers.size) {
      [moved, turning] = [0, event.button === 2 || event.ctrlKey || event.shiftKey];
      drag = turning ? null : picked.grab(...at(surface, event));
    }
    fingers.set(event.pointerId, at(surface, event));
  });
  surface.addEventListener("pointermove", (event) => {
    const [px, py] = at(surface, event);
    const before = fingers.get(event.pointerId);
    if (!before) return picked.hover(px, py);
    const [dx, dy] = [px - before[0], py - before[1]];
    moved += Math.abs(dx) + Math.abs(dy);
    if (fingers.size === 2) {
      const old = spread();
      fingers.set(event.pointerId, [px, py]);
      const now = spread();
      camera.zoom(old.apart / Math.max(1, now.apart), now.middle[0], now.middle[1]);
      camera.pan(now.middle[0] - old.middle[0], now.middle[1] - old.middle[1]);
      camera.set({ bearing: camera.pose.bearing - (now.angle - old.angle) });
      return;
    }
    fingers.set(event.pointerId, [px, py]);
    if (drag) return drag.move(px, py);
    if (turning) camera.set({ bearing: camera.pose.bearing + dx / 200, pitch: camera.pose.pitch + dy / 200 });
    else camera.pan(dx, dy);
  });
  const up = (event: PointerEvent) => {
    const was = fingers.size;
    fingers.delete(event.pointerId);
    if (drag && was === 1) {
      drag.end();
      drag = null;
    } else if (event.type === "pointerup" && was === 1 && moved < CLICK) picked.click(...at(surface, event));
  };
  surface.addEventListener("pointerup", up);
  surface.addEventListener("pointercancel", up);
  surface.addEventListener("pointerleave", () => picked.leave());
  surface.addEventListener("contextmenu", (event) => event.preventDefault());
  surface.addEventListener("wheel", (event) => {
    event.preventDefault();
    camera.zoom(Math.exp(Math.max(-60, Math.min(60, event.deltaY)) / 250), ...at(surface, event));
  }, { passive: false });
  surface.addEventListener("keydown", (event) => {
    if (event.key === "Enter") return picked.click(...camera.middle);
    const action = keys(camera)[event.key];
    if (!action || event.altKey || event.metaKey || event.ctrlKey) return;
    event.preventDefault();
    action(event.shiftKey);
  });
}

function keys(camera: Camera): Record<string, (turn: boolean) => void> {
  const turn = (bearing: number, pitch: number) => camera.set({ bearing: camera.pose.bearing + bearing, pitch: camera.pose.pitch + pitch });
  return {
    ArrowLeft: (turned) => (turned ? turn(-0.15, 0) : camera.pan(80, 0)),
    ArrowRight: (turned) => (turned ? turn(0.15, 0) : camera.pan(-80, 0)),
    ArrowUp: (turned) => (turned ? turn(0, 0.1) : camera.pan(0, 80)),
    ArrowDown: (turned) => (turned ? turn(0, -0.1) : camera.pan(0, -80)),
    "+": () => camera.zoom(0.8),
    "=": () => camera.zoom(0.8),
    "-": () => camera.zoom(1.25),
  };
}

function at(surface: HTMLElement, event: MouseEvent): [number, number] {
  const box = surface.getBoundingClientRect();
  return [event.clientX - box.left, event.clientY - box.top];
}
