// Colours of the map, light and dark. Quiet, so that the answer is what stands out.

export interface Look {
  ground: string;
  street: string;
  path: string;
  crossing: string;
  rail: string;
  square: string;
  green: string;
  wood: string;
  pitch: string;
  water: string;
  building: string;
  low: string; // sheds, canopies
  wall: string;
  tree: string;
  thing: string;
  name: string;
  halo: string;
  accent: string;
  heat: [number, number, number][];
}

export const LIGHT: Look = {
  ground: "#ece8e1",
  street: "#fdfcfa",
  path: "#f6f3ee",
  crossing: "#e3ded5",
  rail: "#cbc5bb",
  square: "#f3efe7",
  green: "#d6e2c6",
  wood: "#c7d8b3",
  pitch: "#cfdcc4",
  water: "#b9d3df",
  building: "#dbd5cb",
  low: "#e3ded6",
  wall: "#cfc8bd",
  tree: "#b3cb9c",
  thing: "#a49c90",
  name: "#5b554c",
  halo: "#fdfcfa",
  accent: "#c8102e",
  heat: [[253, 224, 178], [247, 163, 92], [214, 84, 68], [136, 30, 84], [59, 10, 75]],
};

export const DARK: Look = {
  ground: "#1d1f22",
  street: "#32353a",
  path: "#292c30",
  crossing: "#3d4147",
  rail: "#43474d",
  square: "#27292d",
  green: "#24312a",
  wood: "#1f2e25",
  pitch: "#2a3830",
  water: "#17303c",
  building: "#3b3e44",
  low: "#34373c",
  wall: "#45484e",
  tree: "#2f4636",
  thing: "#767b83",
  name: "#c9c6c0",
  halo: "#17181a",
  accent: "#ff5a6e",
  heat: [[59, 10, 75], [136, 30, 84], [214, 84, 68], [247, 163, 92], [253, 236, 200]],
};

export type Paint = keyof Omit<Look, "heat" | "name" | "halo" | "accent">;

/** What is flat on the ground, by label; what is not listed is not drawn. */
export const GROUND: Record<string, Paint> = {
  bridge: "square", crossing: "crossing", steps: "crossing", platform: "square", "tram track": "rail",
  "railway track": "rail", sidewalk: "path", "cycle path": "path", footpath: "path", parking: "path", road: "street",
  driveway: "path", playground: "pitch", "sports pitch": "pitch", "flower bed": "wood", bushes: "wood", water: "water",
  fountain: "water", "traffic island": "square", trees: "wood", grass: "green", square: "square",
  "market place": "square", "construction site": "crossing", park: "green",
};

/** What rises from an outline, by label. */
export const RISING: Record<string, Paint> = {
  building: "building", church: "building", garage: "low", kiosk: "low", shed: "low", canopy: "low",
};

/** What rises from a line, by label. */
export const WALLS: Record<string, Paint> = {
  hedge: "tree", wall: "wall", fence: "wall", "guard rail": "wall", "bollard row": "wall", "tree row": "tree",
};

/** Colours of what a text mentions: eight that colour-blind eyes tell apart (after Okabe and Ito), on light and on dark. */
export const MENTIONS = ["#0072b2", "#d55e00", "#007a5a", "#a23b87", "#8a6d00", "#3d5a98", "#7a4b2a", "#4d4d4d"];
export const MENTIONS_DARK = ["#56b4e9", "#ff9c50", "#2fd6a3", "#e58bcb", "#f0e442", "#9db6ff", "#d9a57c", "#d0d0d0"];
