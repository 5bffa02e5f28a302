// The map on the page: the picture of it, and over that a flat canvas with names and whatever the answer adds.

import { Camera } from "./camera";
import { control, type Picked } from "./controls";
import { t } from "./language";
import { DARK, LIGHT, wear, type Look } from "./look";
import { Map2d } from "./map2d";
import { Map3d, type MapPicture } from "./map3d";
import { Names, type Room } from "./names";
import type { Scenery } from "./scenery";

const DARKNESS = matchMedia("(prefers-color-scheme: dark)");
const STILL = 250; // milliseconds without a move after which the map is drawn as well as can be

/** Draws over the map, and says whether there was anything to draw; rooms that it takes are kept free of names. */
type Overlay = (pen: CanvasRenderingContext2D, camera: Camera, look: Look, taken: Room[]) => boolean;

export class View {
  readonly camera: Camera;
  overlay: Overlay = () => false;
  drawn: () => void = () => {};
  /** What stands on the map, where names would be hidden. */
  covered: () => Room[] = () => [];
  private readonly picture: MapPicture;
  private readonly over = document.createElement("canvas");
  private sceneries: Scenery[] = [];
  private names: Names[] = [];
  private due = false;
  private moved = false;
  private marked = false; // whether anything is drawn over the map
  private still = 0;

  constructor(private readonly stage: HTMLElement, picked: Picked) {
    this.camera = new Camera(() => this.move());
    this.picture = pictureOf(this.camera);
    this.over.className = "over";
    this.over.tabIndex = 0;
    this.over.setAttribute("role", "application");
    this.over.setAttribute("aria-label", t("map"));
    stage.append(this.picture.canvas, this.over);
    control(this.over, this.camera, picked);
    new ResizeObserver(() => this.fit()).observe(stage);
    DARKNESS.addEventListener("change", () => this.show(this.sceneries));
    wear(this.look);
    this.fit();
  }

  get look(): Look {
    return DARKNESS.matches ? DARK : LIGHT;
  }

  /** The first shows all of the map, further ones have more points. */
  show(sceneries: Scenery[]): void {
    this.sceneries = sceneries;
    wear(this.look);
    this.names = sceneries.flatMap((scenery) => (scenery.kind === "shapes" ? [new Names(scenery)] : []));
    this.picture.show(sceneries, this.look);
    this.move();
  }

  /** What lies over the map, and the map itself only if it has moved. */
  draw(): void {
    if (this.due) return;
    this.due = true;
    requestAnimationFrame(() => {
      this.due = false;
      if (this.moved) this.drawMap();
      const pen = this.over.getContext("2d")!;
      const ratio = Math.min(2, devicePixelRatio);
      pen.setTransform(ratio, 0, 0, ratio, 0, 0);
      if (this.marked) pen.clearRect(0, 0, this.camera.width, this.camera.height); // a canvas that is touched is shown anew
      const taken: Room[] = this.covered();
      this.marked = this.overlay(pen, this.camera, this.look, taken);
      for (const names of this.names) if (names.draw(pen, this.camera, this.look, taken)) this.marked = true;
      this.drawn();
    });
  }

  private move(): void {
    this.moved = true;
    this.draw();
  }

  private drawMap(): void {
    this.moved = false;
    this.picture.draw(true);
    clearTimeout(this.still);
    this.still = window.setTimeout(() => this.picture.draw(false), STILL);
  }

  private fit(): void {
    const ratio = Math.min(2, devicePixelRatio);
    [this.camera.width, this.camera.height] = [Math.max(1, this.stage.clientWidth), Math.max(1, this.stage.clientHeight)];
    [this.over.width, this.over.height] = [this.camera.width * ratio, this.camera.height * ratio];
    this.move();
  }
}

function pictureOf(camera: Camera): MapPicture {
  try {
    return new Map3d(camera);
  } catch {
    return new Map2d(camera); // no WebGL
  }
}
