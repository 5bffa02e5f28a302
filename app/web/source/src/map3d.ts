// The map as a scene: flat ground, buildings raised to their height, trees; or a cloud of points. Drawn when it changes.

import {
  BoxGeometry, BufferAttribute, BufferGeometry, Color, ColorManagement, DoubleSide, FrontSide, IcosahedronGeometry, InstancedMesh,
  LineBasicMaterial, LinearSRGBColorSpace, LineSegments, Matrix4, Mesh, MeshBasicMaterial, type Object3D, PerspectiveCamera,
  Points, PointsMaterial, Scene, WebGLRenderer,
} from "three";
import { mergeGeometries } from "three/examples/jsm/utils/BufferGeometryUtils.js";
import { FIELD_OF_VIEW, type Camera } from "./camera";
import { GROUND, RISING, WALLS, type Look, type Paint } from "./look";
import { Triangles, coarser, fill, raise, widen } from "./mesh";
import { AREA, POINT, type Cloud, type Scenery, type Shape, type Shapes } from "./scenery";

const CLOSE = 900; // metres from which small things are drawn
const FAR = 1500; // from which on a CPU draws no walls and paths while the map moves: it is triangles that cost it time
const FARTHER = 3500; // from which on paths are thinner than a pixel
const OVERVIEW = 3000; // from which on a CPU draws no corner that is nearer than COARSE metres to the one before while the map moves
const COARSE = 10;
const NARROW = new Set<Paint>(["path", "crossing", "rail"]);
const TILE = 1200; // metres; what lies in tiles out of sight is not drawn

export interface MapPicture {
  readonly canvas: HTMLCanvasElement;
  show(sceneries: Scenery[], look: Look): void;
  /** `hurried` leaves out what a slow machine can do without while the map moves. */
  draw(hurried: boolean): void;
}

export class Map3d implements MapPicture {
  readonly canvas = document.createElement("canvas");
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly eye = new PerspectiveCamera(FIELD_OF_VIEW);
  private readonly small: Object3D[] = []; // drawn from near
  private readonly rough: Object3D[] = []; // drawn from afar
  private readonly narrow: Object3D[] = []; // drawn but from very far
  private readonly upright: Object3D[] = []; // drawn from afar when there is time
  private readonly fine: Object3D[] = []; // drawn when there is time
  private readonly exact: Object3D[] = []; // drawn from near, and from afar when there is time
  private readonly coarse: Object3D[] = []; // what is drawn for it when there is none
  private readonly slow = isSoftware();

  constructor(private readonly camera: Camera) {
    this.renderer = new WebGLRenderer({ canvas: this.canvas, antialias: !this.slow, powerPreference: "high-performance" });
    ColorManagement.enabled = false; // colours go to the screen as they are written
    this.renderer.outputColorSpace = LinearSRGBColorSpace;
  }

  show(sceneries: Scenery[], look: Look): void {
    this.scene.traverse((object) => {
      const { geometry, material } = object as Mesh;
      geometry?.dispose();
      for (const each of [material].flat()) each?.dispose();
    });
    this.scene.clear();
    for (const some of [this.small, this.rough, this.narrow, this.upright, this.fine, this.exact, this.coarse]) some.length = 0;
    this.scene.background = new Color(look.ground);
    for (const scenery of sceneries) {
      if (scenery.kind === "points") this.scene.add(cloud(scenery));
      else this.build(scenery, look);
    }
  }

  draw(hurried: boolean): void {
    const { camera, renderer, eye } = this;
    const ratio = Math.min(2, devicePixelRatio);
    const [wide, high] = [camera.width, camera.height].map((size) => Math.floor(size * ratio));
    if (this.canvas.width !== wide || this.canvas.height !== high) {
      renderer.setPixelRatio(ratio);
      renderer.setSize(camera.width, camera.height, false);
    }
    Object.assign(eye, { aspect: camera.width / camera.height, ...camera.limits });
    eye.position.set(...camera.eye);
    const { x, y, bearing } = camera.shifted;
    if (camera.pose.pitch > 1.55) eye.up.set(Math.sin(bearing), Math.cos(bearing), 0); // from the top, what is ahead is up
    else eye.up.set(0, 0, 1);
    eye.lookAt(x, y, 0);
    eye.updateProjectionMatrix();
    const [{ distance }, hurries] = [camera.pose, this.slow && hurried];
    for (const object of this.small) object.visible = distance < CLOSE;
    for (const object of this.rough) object.visible = distance >= CLOSE && !hurries;
    for (const object of this.narrow) object.visible = distance < (hurries ? FAR : FARTHER);
    for (const object of this.upright) object.visible = distance < FAR || !hurries;
    for (const object of this.exact) object.visible = distance < OVERVIEW || !hurries;
    for (const object of this.coarse) object.visible = distance >= OVERVIEW && hurries;
    for (const object of this.fine) object.visible = !hurries;
    renderer.render(this.scene, eye);
  }

  private build(map: Shapes, look: Look): void {
    const by = new Map<string, Shape[]>();
    for (const label of map.labels) by.set(label, []);
    for (const shape of map.shapes) by.get(shape.label)!.push(shape);
    map.labels.forEach((label, n) => {
      const shapes = by.get(label) ?? [];
      if (label in GROUND) this.flat(shapes, GROUND[label], look, map.labels.length - n);
    });
    this.buildings(by, look);
    this.walls(by, look);
    this.trees(by.get("tree") ?? [], look);
    this.things(map.shapes.filter((shape) => shape.form === POINT && shape.label !== "tree"), look);
    if (this.slow) this.overview(map.labels, by, look);
  }

  private flat(shapes: Shape[], paint: Paint, look: Look, order: number): void {
    const material = new MeshBasicMaterial({ vertexColors: true, side: DoubleSide, depthTest: false, depthWrite: false });
    for (const [narrow, shown] of [[false, this.exact], [true, this.narrow]] as const) {
      for (const tile of tiles(shapes.filter((shape) => isNarrow(shape, paint) === narrow))) {
        const mesh = new Mesh(geometry(ground(tile), new Color(look[paint])), material);
        mesh.renderOrder = order - 1000;
        this.add(mesh, shown);
      }
    }
  }

  /** Ground and roofs as a CPU draws them from afar while the map moves: one mesh of each, with few corners. */
  private overview(labels: string[], by: Map<string, Shape[]>, look: Look): void {
    const of = (label: string) => (by.get(label) ?? []).map((shape) => coarser(shape, COARSE)).filter(({ paths }) => paths.length);
    const flat = labels.filter((label) => label in GROUND).reverse().map((label) => { // what lies on top comes last
      const wide = of(label).filter((shape) => !isNarrow(shape, GROUND[label]));
      return geometry(ground(wide), new Color(look[GROUND[label]]));
    });
    const high = Object.entries(RISING).map(([label, paint]) => geometry(roofs(of(label)), new Color(look[paint])));
    for (const [parts, order, depthTest] of [[flat, -1000, false], [high, 0, true]] as const) {
      if (!parts.length) continue;
      const material = new MeshBasicMaterial({ vertexColors: true, side: depthTest ? FrontSide : DoubleSide, depthTest, depthWrite: depthTest });
      const mesh = new Mesh(mergeGeometries(parts), material);
      mesh.renderOrder = order;
      this.add(mesh, this.coarse);
    }
  }

  private buildings(by: Map<string, Shape[]>, look: Look): void {
    const [material, edge] = [
      new MeshBasicMaterial({ vertexColors: true, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 }),
      new LineBasicMaterial({ color: new Color(look.building).multiplyScalar(0.72), transparent: true, opacity: 0.55 }),
    ];
    for (const [label, paint] of Object.entries(RISING)) {
      for (const tile of tiles((by.get(label) ?? []).filter((shape) => shape.form === AREA))) {
        const [sides, edges] = [new Triangles(), [] as number[]];
        this.add(new Mesh(geometry(roofs(tile), new Color(look[paint])), material), this.exact);
        for (const shape of tile) {
          const top = roof(shape);
          raise(sides, shape, shape.base, top);
          for (const path of shape.paths) {
            for (let n = 0; n + 3 < path.length; n += 2) edges.push(path[n], path[n + 1], top, path[n + 2], path[n + 3], top);
          }
        }
        this.add(new Mesh(geometry(sides, new Color(look[paint])), material), this.upright);
        const lines = new BufferGeometry().setAttribute("position", new BufferAttribute(new Float32Array(edges), 3));
        this.add(new LineSegments(lines, edge), this.fine);
      }
    }
  }

  private walls(by: Map<string, Shape[]>, look: Look): void {
    const material = new MeshBasicMaterial({ vertexColors: true, side: DoubleSide });
    for (const [label, paint] of Object.entries(WALLS)) {
      for (const tile of tiles(by.get(label) ?? [])) {
        const out = new Triangles();
        for (const shape of tile) raise(out, shape, shape.base, shape.top);
        this.add(new Mesh(geometry(out, new Color(look[paint])), material), this.small);
      }
    }
  }

  private trees(trees: Shape[], look: Look): void {
    const material = new MeshBasicMaterial({ vertexColors: true, color: look.tree });
    for (const [detail, shown] of [[1, this.small], [0, this.rough]] as const) {
      const shape = crown(detail);
      this.copies(trees, shape, material, shown, (tree) => {
        const radius = Math.max(1.6, tree.top / 4);
        return [radius, radius, Math.max(radius, tree.top - radius)];
      });
    }
  }

  private things(things: Shape[], look: Look): void {
    this.copies(things, new BoxGeometry(1, 1, 1), new MeshBasicMaterial({ color: look.thing }), this.small, (thing) => {
      const high = Math.max(0.6, thing.top - thing.base);
      return [high > 2.2 ? 0.3 : 0.8, high, thing.base + high / 2];
    });
  }

  /** One form at many points; `size` gives width, height and how high its middle is. */
  private copies(points: Shape[], form: BufferGeometry, material: MeshBasicMaterial, shown: Object3D[], size: (point: Shape) => [number, number, number]): void {
    const matrix = new Matrix4();
    for (const tile of tiles(points)) {
      const mesh = new InstancedMesh(form, material, tile.length);
      tile.forEach((point, n) => {
        const [wide, high, middle] = size(point);
        mesh.setMatrixAt(n, matrix.makeScale(wide, wide, high).setPosition(point.paths[0][0], point.paths[0][1], middle));
      });
      this.add(mesh, shown);
    }
  }

  /** `shown` are those that are drawn from near or from afar alone. */
  private add(object: Object3D, shown?: Object3D[]): void {
    object.matrixAutoUpdate = false;
    shown?.push(object);
    this.scene.add(object);
  }
}

function isNarrow(shape: Shape, paint: Paint): boolean {
  return NARROW.has(paint) && shape.form !== AREA;
}

function ground(shapes: Shape[]): Triangles {
  const out = new Triangles();
  for (const shape of shapes) {
    if (shape.form === AREA) fill(out, shape, 0);
    else if (shape.form !== POINT) widen(out, shape, 0);
  }
  return out;
}

function roof(shape: Shape): number {
  return Math.max(shape.top, shape.base + 0.5);
}

function roofs(shapes: Shape[]): Triangles {
  const out = new Triangles();
  for (const shape of shapes.filter(({ form }) => form === AREA)) fill(out, shape, roof(shape));
  return out;
}

/** Shapes by the tile that they begin in. */
function tiles(shapes: Shape[]): Iterable<Shape[]> {
  const found = new Map<string, Shape[]>();
  for (const shape of shapes) {
    const tile = `${Math.floor(shape.paths[0][0] / TILE)} ${Math.floor(shape.paths[0][1] / TILE)}`;
    if (!found.has(tile)) found.set(tile, []);
    found.get(tile)!.push(shape);
  }
  return found.values();
}

/** A tree's, lighter from above. */
function crown(detail: number): BufferGeometry {
  const shape = new IcosahedronGeometry(1, detail);
  const normals = shape.getAttribute("normal");
  const shade = new Float32Array(normals.count * 3);
  for (let n = 0; n < normals.count; n++) shade.fill(0.86 + 0.14 * normals.getZ(n), 3 * n, 3 * n + 3);
  return shape.setAttribute("color", new BufferAttribute(shade, 3));
}

/** Whether a CPU draws: smooth edges cost it twice the time. */
function isSoftware(): boolean {
  const probe = document.createElement("canvas").getContext("webgl2");
  const told = probe?.getExtension("WEBGL_debug_renderer_info");
  const name = told ? String(probe!.getParameter(told.UNMASKED_RENDERER_WEBGL)) : "";
  probe?.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|software/i.test(name);
}

function geometry(out: Triangles, colour: Color): BufferGeometry {
  const colours = new Uint8Array(out.shades.length * 3);
  out.shades.forEach((shade, n) => {
    const { r, g, b } = colour;
    colours.set([r * shade * 255, g * shade * 255, b * shade * 255], 3 * n);
  });
  return new BufferGeometry()
    .setAttribute("position", new BufferAttribute(new Float32Array(out.positions), 3))
    .setAttribute("color", new BufferAttribute(colours, 3, true))
    .setIndex(out.index);
}

function cloud(points: Cloud): Points {
  const shape = new BufferGeometry()
    .setAttribute("position", new BufferAttribute(points.xyz, 3))
    .setAttribute("color", new BufferAttribute(points.rgb, 3, true));
  const made = new Points(shape, new PointsMaterial({ size: 0.8, vertexColors: true }));
  return made;
}
