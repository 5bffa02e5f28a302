// The map on a flat canvas, for browsers without WebGL: the same colours, seen from above.

import type { Camera } from "./camera";
import { GROUND, RISING, WALLS, type Look, type Paint } from "./look";
import type { MapPicture } from "./map3d";
import { polygons } from "./mesh";
import { AREA, LINE, type Scenery, type Shapes } from "./scenery";

interface Layer {
  paint: string;
  edge: string | null;
  areas: Path2D;
  lines: Map<number, Path2D>; // by width, metres
}

export class Map2d implements MapPicture {
  readonly canvas = document.createElement("canvas");
  private readonly pen = this.canvas.getContext("2d")!;
  private layers: Layer[] = [];
  private sceneries: Scenery[] = [];
  private background = "";

  constructor(private readonly camera: Camera) {
    camera.flat = true;
    camera.set({});
  }

  show(sceneries: Scenery[], look: Look): void {
    this.sceneries = sceneries;
    this.background = look.ground;
    this.layers = sceneries.flatMap((scenery) => (scenery.kind === "shapes" ? layers(scenery, look) : []));
  }

  draw(): void {
    const { camera, canvas, pen } = this;
    const ratio = Math.min(2, devicePixelRatio);
    [canvas.width, canvas.height] = [camera.width * ratio, camera.height * ratio];
    pen.fillStyle = this.background;
    pen.fillRect(0, 0, canvas.width, canvas.height);
    const scale = ratio / camera.metresAPixel;
    const [x, y] = camera.project(0, 0) ?? [0, 0];
    pen.setTransform(scale, 0, 0, -scale, x * ratio, y * ratio);
    for (const layer of this.layers) {
      pen.fillStyle = pen.strokeStyle = layer.paint;
      pen.fill(layer.areas, "evenodd");
      for (const [width, path] of layer.lines) {
        pen.lineWidth = Math.max(width, camera.metresAPixel);
        pen.stroke(path);
      }
      if (layer.edge) {
        pen.strokeStyle = layer.edge;
        pen.lineWidth = camera.metresAPixel;
        pen.stroke(layer.areas);
      }
    }
    for (const scenery of this.sceneries) {
      if (scenery.kind !== "points") continue;
      const size = Math.max(0.3, camera.metresAPixel);
      for (let n = 0; n < scenery.xyz.length / 3; n++) {
        pen.fillStyle = `rgb(${scenery.rgb.subarray(3 * n, 3 * n + 3).join()})`;
        pen.fillRect(scenery.xyz[3 * n], scenery.xyz[3 * n + 1], size, size);
      }
    }
    pen.setTransform(1, 0, 0, 1, 0, 0);
  }
}

function layers(map: Shapes, look: Look): Layer[] {
  const paints: Record<string, Paint> = { ...GROUND, ...RISING, ...WALLS };
  const ground = [...map.labels].reverse().filter((label) => label in GROUND);
  return [...ground, ...Object.keys(WALLS), ...Object.keys(RISING)].map((label) => {
    const layer: Layer = { paint: look[paints[label]], edge: label in RISING ? look.rail : null, areas: new Path2D(), lines: new Map() };
    for (const shape of map.shapes) {
      if (shape.label !== label) continue;
      if (shape.form === AREA) for (const ring of polygons(shape).flat()) trace(layer.areas, ring);
      if (shape.form === LINE) {
        const width = Math.round(Math.max(0.6, shape.width));
        if (!layer.lines.has(width)) layer.lines.set(width, new Path2D());
        for (const path of shape.paths) trace(layer.lines.get(width)!, path);
      }
    }
    return layer;
  });
}

function trace(path: Path2D, xy: Float32Array): void {
  path.moveTo(xy[0], xy[1]);
  for (let n = 2; n < xy.length; n += 2) path.lineTo(xy[n], xy[n + 1]);
}
