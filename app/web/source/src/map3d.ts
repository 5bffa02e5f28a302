// The map as a scene: flat ground, buildings raised to their height, trees; or a cloud of points. Drawn when it changes.

import {
  BoxGeometry, BufferAttribute, BufferGeometry, Color, ColorManagement, DoubleSide, IcosahedronGeometry, InstancedMesh,
  LineBasicMaterial, LinearSRGBColorSpace, LineSegments, Matrix4, Mesh, MeshBasicMaterial, type Object3D, PerspectiveCamera,
  Points, PointsMaterial, Scene, WebGLRenderer,
} from "three";
import { FIELD_OF_VIEW, type Camera } from "./camera";
import { GROUND, RISING, WALLS, type Look, type Paint } from "./look";
import { Triangles, fill, raise, widen } from "./mesh";
import { AREA, POINT, type Cloud, type Scenery, type Shape, type Shapes } from "./scenery";

const CLOSE = 900; // metres from which small things are drawn

export interface MapPicture {
  readonly canvas: HTMLCanvasElement;
  show(sceneries: Scenery[], look: Look): void;
  draw(): void;
}

export class Map3d implements MapPicture {
  readonly canvas = document.createElement("canvas");
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly eye = new PerspectiveCamera(FIELD_OF_VIEW);
  private small: Object3D[] = [];

  constructor(private readonly camera: Camera) {
    this.renderer = new WebGLRenderer({ canvas: this.canvas, antialias: true, powerPreference: "high-performance" });
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
    this.small = [];
    this.scene.background = new Color(look.ground);
    for (const scenery of sceneries) {
      if (scenery.kind === "points") this.scene.add(cloud(scenery));
      else this.build(scenery, look);
    }
  }

  draw(): void {
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
    for (const object of this.small) object.visible = camera.pose.distance < CLOSE;
    renderer.render(this.scene, eye);
  }

  private build(map: Shapes, look: Look): void {
    const by = new Map<string, Shape[]>();
    for (const label of map.labels) by.set(label, []);
    for (const shape of map.shapes) by.get(shape.label)!.push(shape);
    map.labels.forEach((label, n) => {
      const shapes = by.get(label) ?? [];
      if (label in GROUND) this.flat(shapes, look[GROUND[label]], map.labels.length - n);
    });
    this.buildings(by, look);
    this.walls(by, look);
    this.trees(by.get("tree") ?? [], look);
    this.things(map.shapes.filter((shape) => shape.form === POINT && shape.label !== "tree"), look);
  }

  private flat(shapes: Shape[], paint: string, order: number): void {
    const out = new Triangles();
    for (const shape of shapes) {
      if (shape.form === AREA) fill(out, shape, 0);
      else if (shape.form !== POINT) widen(out, shape, 0);
    }
    const mesh = new Mesh(geometry(out, new Color(paint)), new MeshBasicMaterial({ vertexColors: true, side: DoubleSide, depthTest: false, depthWrite: false }));
    mesh.renderOrder = order - 1000;
    this.add(mesh);
  }

  private buildings(by: Map<string, Shape[]>, look: Look): void {
    const edges: number[] = [];
    for (const [label, paint] of Object.entries(RISING) as [string, Paint][]) {
      const out = new Triangles();
      for (const shape of by.get(label) ?? []) {
        if (shape.form !== AREA) continue;
        const top = Math.max(shape.top, shape.base + 0.5);
        raise(out, shape, shape.base, top);
        fill(out, shape, top, 1);
        for (const path of shape.paths) {
          for (let n = 0; n + 3 < path.length; n += 2) edges.push(path[n], path[n + 1], top, path[n + 2], path[n + 3], top);
        }
      }
      this.add(new Mesh(geometry(out, new Color(look[paint])), new MeshBasicMaterial({ vertexColors: true, side: DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 })));
    }
    const lines = new BufferGeometry().setAttribute("position", new BufferAttribute(new Float32Array(edges), 3));
    this.add(new LineSegments(lines, new LineBasicMaterial({ color: new Color(look.building).multiplyScalar(0.72), transparent: true, opacity: 0.55 })));
  }

  private walls(by: Map<string, Shape[]>, look: Look): void {
    for (const [label, paint] of Object.entries(WALLS) as [string, Paint][]) {
      const out = new Triangles();
      for (const shape of by.get(label) ?? []) raise(out, shape, shape.base, shape.top);
      const mesh = new Mesh(geometry(out, new Color(look[paint])), new MeshBasicMaterial({ vertexColors: true, side: DoubleSide }));
      this.small.push(mesh);
      this.add(mesh);
    }
  }

  private trees(trees: Shape[], look: Look): void {
    const crown = new IcosahedronGeometry(1, 1);
    const normals = crown.getAttribute("normal");
    const shade = new Float32Array(normals.count * 3);
    for (let n = 0; n < normals.count; n++) shade.fill(0.86 + 0.14 * normals.getZ(n), 3 * n, 3 * n + 3);
    crown.setAttribute("color", new BufferAttribute(shade, 3));
    const mesh = new InstancedMesh(crown, new MeshBasicMaterial({ vertexColors: true, color: look.tree }), trees.length);
    const matrix = new Matrix4();
    trees.forEach((tree, n) => {
      const [x, y] = tree.paths[0];
      const radius = Math.max(1.6, tree.top / 4);
      mesh.setMatrixAt(n, matrix.makeScale(radius, radius, radius).setPosition(x, y, Math.max(radius, tree.top - radius)));
    });
    this.add(mesh);
  }

  private things(things: Shape[], look: Look): void {
    const mesh = new InstancedMesh(new BoxGeometry(1, 1, 1), new MeshBasicMaterial({ color: look.thing }), things.length);
    const matrix = new Matrix4();
    things.forEach((thing, n) => {
      const [x, y] = thing.paths[0];
      const high = Math.max(0.6, thing.top - thing.base);
      const wide = high > 2.2 ? 0.3 : 0.8;
      mesh.setMatrixAt(n, matrix.makeScale(wide, wide, high).setPosition(x, y, thing.base + high / 2));
    });
    this.small.push(mesh);
    this.add(mesh);
  }

  private add(object: Object3D): void {
    object.matrixAutoUpdate = false;
    object.frustumCulled = false;
    this.scene.add(object);
  }
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
  const made = new Points(shape, new PointsMaterial({ size: 0.35, vertexColors: true }));
  made.frustumCulled = false;
  return made;
}
