// Where the map is looked at from. One model for both pictures of the map: three.js and the flat canvas.

import type { Box } from "./scenery";

export const FIELD_OF_VIEW = 40; // degrees, of the height
export const TOP = Math.PI / 2;
const LEAST_PITCH = 0.45;
const NEAREST = 40; // metres from the ground
const HALF = Math.tan((FIELD_OF_VIEW * Math.PI) / 360);

export interface Pose {
  x: number; // what is in the middle, metres
  y: number;
  distance: number; // of the eye from it
  pitch: number; // TOP looks straight down
  bearing: number; // what is up on the screen, clockwise from north
}

export class Camera {
  pose: Pose = { x: 0, y: 0, distance: 1500, pitch: 0.95, bearing: 0 };
  width = 1;
  height = 1;
  /** Pixels at the sides that a panel covers. */
  private inset = { left: 0, bottom: 0 };
  flat = false;
  private farthest = 20000;
  private flight = 0;

  constructor(private readonly changed: () => void) {}

  /** What is looked at stands in the middle of what a panel does not cover. */
  cover(inset: { left: number; bottom: number }): void {
    this.inset = inset;
    this.changed();
  }

  get eye(): [number, number, number] {
    const { x, y, distance, pitch, bearing } = this.shifted;
    const back = distance * Math.cos(pitch);
    return [x - back * Math.sin(bearing), y - back * Math.cos(bearing), distance * Math.sin(pitch)];
  }

  /** The pose of the middle of the whole window, part of which a panel covers. */
  get shifted(): Pose {
    const metres = this.metresAPixel;
    const { bearing, pitch } = this.pose;
    const right = (-this.inset.left / 2) * metres;
    const up = ((-this.inset.bottom / 2) * metres) / Math.sin(pitch);
    return {
      ...this.pose,
      x: this.pose.x + right * Math.cos(bearing) + up * Math.sin(bearing),
      y: this.pose.y - right * Math.sin(bearing) + up * Math.cos(bearing),
    };
  }

  /** Where on the screen what is looked at stands. */
  get middle(): [number, number] {
    return [(this.width + this.inset.left) / 2, (this.height - this.inset.bottom) / 2];
  }

  /** At the point that is looked at. */
  get metresAPixel(): number {
    return (2 * this.pose.distance * HALF) / this.height;
  }

  get limits(): { near: number; far: number } {
    return { near: this.pose.distance / 20, far: this.pose.distance * 6 + 2000 };
  }

  /** Where a place is on the screen; null if it is behind the eye. */
  project(x: number, y: number, z = 0): [number, number] | null {
    const { bearing, pitch } = this.pose;
    const [ex, ey, ez] = this.eye;
    const [dx, dy, dz] = [x - ex, y - ey, z - ez];
    const right = dx * Math.cos(bearing) - dy * Math.sin(bearing);
    const ahead = dx * Math.sin(bearing) + dy * Math.cos(bearing);
    const depth = ahead * Math.cos(pitch) - dz * Math.sin(pitch);
    if (depth < this.limits.near) return null;
    const up = ahead * Math.sin(pitch) + dz * Math.cos(pitch);
    const scale = this.height / (2 * HALF * depth);
    return [this.width / 2 + right * scale, this.height / 2 - up * scale];
  }

  /** The ground under a pixel; null above the horizon. */
  ground(px: number, py: number): [number, number] | null {
    const { bearing, pitch } = this.pose;
    const scale = (2 * HALF) / this.height;
    const [right, up] = [(px - this.width / 2) * scale, (this.height / 2 - py) * scale];
    const ahead = Math.cos(pitch) + up * Math.sin(pitch);
    const down = Math.sin(pitch) - up * Math.cos(pitch);
    if (down < 0.02) return null;
    const [ex, ey, ez] = this.eye;
    const far = ez / down;
    return [
      ex + far * (right * Math.cos(bearing) + ahead * Math.sin(bearing)),
      ey + far * (ahead * Math.cos(bearing) - right * Math.sin(bearing)),
    ];
  }

  set(pose: Partial<Pose>): void {
    cancelAnimationFrame(this.flight);
    this.pose = this.allowed({ ...this.pose, ...pose });
    this.changed();
  }

  /** Shows a box. */
  frame(box: Box, instantly = false, least = 60): void {
    const [wide, high] = [box.east - box.west, box.north - box.south];
    const free = { width: Math.max(80, this.width - this.inset.left), height: Math.max(80, this.height - this.inset.bottom) };
    const metres = Math.max(least / free.height, (1.1 * wide) / free.width, (1.1 * high * Math.sin(this.pose.pitch)) / free.height);
    this.farthest = Math.max(this.farthest, 1.5 * metres * this.height);
    const target = { x: (box.west + box.east) / 2, y: (box.south + box.north) / 2, distance: (metres * this.height) / (2 * HALF) };
    while (target.distance < this.farthest && !this.holds(target, box)) target.distance *= 1.06;
    this.fly(target, instantly);
  }

  /** Whether a box would be seen whole, what is near is larger. */
  private holds(target: Partial<Pose>, box: Box): boolean {
    const before = this.pose;
    this.pose = this.allowed({ ...before, ...target });
    const corners = [[box.west, box.south], [box.east, box.south], [box.west, box.north], [box.east, box.north]];
    const whole = corners.every(([x, y]) => {
      const at = this.project(x, y);
      return at && at[0] >= this.inset.left && at[0] <= this.width && at[1] >= 0 && at[1] <= this.height - this.inset.bottom;
    });
    this.pose = before;
    return whole;
  }

  fly(to: Partial<Pose>, instantly = false): void {
    cancelAnimationFrame(this.flight);
    const [from, target] = [this.pose, this.allowed({ ...this.pose, ...to })];
    const still = instantly || matchMedia("(prefers-reduced-motion: reduce)").matches;
    const start = performance.now();
    const step = (now: number) => {
      const share = still ? 1 : Math.min(1, (now - start) / 290);
      const eased = 1 - (1 - share) ** 3;
      const between = (a: number, b: number) => a + (b - a) * eased;
      this.pose = {
        x: between(from.x, target.x),
        y: between(from.y, target.y),
        distance: Math.exp(between(Math.log(from.distance), Math.log(target.distance))),
        pitch: between(from.pitch, target.pitch),
        bearing: between(from.bearing, target.bearing),
      };
      this.changed();
      if (share < 1) this.flight = requestAnimationFrame(step);
    };
    if (still) step(start);
    else this.flight = requestAnimationFrame(step);
  }

  /** Moves what is in the middle by pixels of the screen. */
  pan(px: number, py: number): void {
    const metres = this.metresAPixel;
    const { bearing, pitch, x, y } = this.pose;
    const [right, up] = [-px * metres, (py * metres) / Math.sin(pitch)];
    this.set({
      x: x + right * Math.cos(bearing) + up * Math.sin(bearing),
      y: y - right * Math.sin(bearing) + up * Math.cos(bearing),
    });
  }

  /** Zooms, and leaves the ground under a pixel where it is. */
  zoom(factor: number, px = this.middle[0], py = this.middle[1]): void {
    const before = this.ground(px, py);
    this.set({ distance: this.pose.distance * factor });
    const after = this.ground(px, py);
    if (before && after) this.set({ x: this.pose.x + before[0] - after[0], y: this.pose.y + before[1] - after[1] });
  }

  private allowed(pose: Pose): Pose {
    return {
      ...pose,
      distance: Math.min(this.farthest, Math.max(NEAREST, pose.distance)),
      pitch: this.flat ? TOP : Math.min(TOP, Math.max(LEAST_PITCH, pose.pitch)),
      bearing: this.flat ? 0 : pose.bearing,
    };
  }
}
