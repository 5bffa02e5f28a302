// At the foot of the map: scale, north, top view, and whose map it is.

import type { Info } from "./api";
import { TOP } from "./camera";
import { byId } from "./dom";
import { t } from "./language";
import type { View } from "./view";
import { metres } from "./words";

const NICE = [1, 2, 5];
const LONGEST = 110; // pixels
const TILTED = 0.95;

export function legend(view: View, info: () => Info | null): void {
  const [north, tilt, scale, attribution] = [byId("north"), byId("tilt"), byId("scale"), byId("attribution")];
  north.addEventListener("click", () => view.camera.fly({ bearing: 0 }));
  tilt.addEventListener("click", () => view.camera.fly({ pitch: view.camera.pose.pitch === TOP ? TILTED : TOP }));
  view.drawn = () => {
    const { metresAPixel, pose, flat } = view.camera;
    let length = 1;
    for (let ten = 1; ten < 1e6; ten *= 10) for (const nice of NICE) if (nice * ten <= LONGEST * metresAPixel) length = nice * ten;
    scale.style.width = `${length / metresAPixel}px`;
    say(scale, metres(length), t("scale", { length: metres(length) }));
    north.hidden = Math.abs(pose.bearing) < 0.01;
    north.style.transform = `rotate(${-pose.bearing}rad)`;
    tilt.hidden = flat;
    if (pose.pitch === TOP) say(tilt, "3D", t("fromSide"));
    else say(tilt, "2D", t("fromAbove"));
    say(attribution, info()?.index?.provenance.attribution ?? "");
  };
}

/** What has not changed is left alone, so that the page is not laid out anew. */
function say(element: HTMLElement, text: string, label?: string): void {
  if (element.textContent === text) return;
  element.textContent = text;
  if (label) element.setAttribute("aria-label", label);
}
