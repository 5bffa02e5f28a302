// Colours of the map, light and dark: quiet, so that the answer is what stands out. The service's own pictures have them too.

import given from "../../../../models/citymap/scenery/look.json";

/** `mentions` are of what a text mentions: eight that colour-blind eyes tell apart (after Okabe and Ito). */
export type Look = Omit<typeof given.light, "heat"> & { heat: number[][] };
export type Paint = keyof Omit<Look, "heat" | "name" | "halo" | "accent" | "mentions">;

export const LIGHT: Look = given.light;
export const DARK: Look = given.dark;

/** What is flat on the ground, what rises from an outline and what rises from a line, by label; the rest is no more than a mark. */
export const GROUND = given.ground as Record<string, Paint>;
export const RISING = given.rising as Record<string, Paint>;
export const WALLS = given.walls as Record<string, Paint>;

/** Gives the page around the map those of its colours that mean the same there. */
export function wear(look: Look): void {
  const { style } = document.documentElement;
  style.setProperty("--accent", look.accent);
  look.mentions.forEach((colour, n) => style.setProperty(`--m${n}`, colour));
}
