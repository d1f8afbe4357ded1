// Bundles the page into the package. `view.js` is the stage with three.js; `app.js` is the rest and imports it. Equal
// sources give equal bytes.
import { build } from "esbuild";
import { copyFileSync, mkdirSync } from "node:fs";

const out = process.argv[2] ?? "../../python/niwaki/studio/page";
mkdirSync(out, { recursive: true });
const view = {
  name: "view",
  setup: ({ onResolve }) => onResolve({ filter: /^\.\.?\/view$/ }, () => ({ path: "/view.js", external: true })),
};
await build({
  entryPoints: { app: "src/main.tsx", view: "src/view.ts" },
  outdir: out,
  bundle: true,
  minify: true,
  format: "esm",
  target: "es2022",
  jsx: "automatic",
  jsxImportSource: "preact",
  legalComments: "eof",
  external: ["/inter.woff2"],
  plugins: [view],
});
copyFileSync("src/index.html", `${out}/index.html`);
copyFileSync("node_modules/@fontsource-variable/inter/files/inter-latin-wght-normal.woff2", `${out}/inter.woff2`);
