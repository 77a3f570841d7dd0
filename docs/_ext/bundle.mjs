// Bundles scripts with what they take from npm: node bundle.mjs JOB, a JSON text that names the
// entries, the folder, the format and what is known as RUN. Prints the packages that went in.
import { build } from "esbuild";

const job = JSON.parse(process.argv[2]);
const { metafile } = await build({
  entryPoints: job.entries,
  outdir: job.folder,
  format: job.format,
  define: { RUN: JSON.stringify(job.run) },
  loader: { ".py": "text" },
  external: ["node:*", "ws"], // Pyodide names them, for node
  bundle: true,
  minify: true,
  metafile: true,
  logLevel: "error",
});
const packages = Object.keys(metafile.inputs).map((path) => path.match(/node_modules\/((@[^/]+\/)?[^/]+)/)?.[1]);
console.log(JSON.stringify([...new Set(packages)].filter(Boolean).sort()));
