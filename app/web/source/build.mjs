// Bundles the page into ../page, which is what the service sends; the same input gives the same bytes.
import { copyFile } from "node:fs/promises";
import { build } from "esbuild";

await build({
  entryPoints: { page: "src/main.ts", style: "src/style.css" },
  outdir: "../page",
  bundle: true,
  minify: true,
  format: "esm",
  target: "es2022",
  legalComments: "linked",
  logLevel: "warning",
});
for (const file of ["index.html", "icon.svg"]) await copyFile(file, `../page/${file}`);
