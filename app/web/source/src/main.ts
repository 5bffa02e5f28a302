import { readScenery } from "./scenery";
import { View } from "./view";

const view = new View(document.getElementById("map")!, { click() {}, hover() {}, leave() {} });
const info = await (await fetch("info")).json();
const name: string = info.index.provenance.map;
const scenery = readScenery(await (await fetch(`maps/${encodeURIComponent(name)}/points`)).arrayBuffer());
view.show([scenery]);
view.camera.frame(scenery.box, true);
