// Compiles Python with the Python that runs in the page: node compile.mjs JOB.json
// The job names a zip of sources, whose members are paths in the page, and the zip to write.
// With packages in the job's folder, a picture is drawn with them first, and only what that takes is
// compiled: bytecode starts quicker but is larger.
import { readFile, writeFile } from "node:fs/promises";
import { loadPyodide } from "pyodide";

const DRAW = `
import ast, base64, contextlib, inspect, io, json, linecache, sys, traceback
import numpy, scipy.linalg, scipy.spatial
import matplotlib
matplotlib.use("agg")
import matplotlib.animation, matplotlib.font_manager, matplotlib.pyplot as plt
from mpl_toolkits import mplot3d
from PIL import Image

plt.style.use("default")
numpy.savetxt("/numbers.txt", numpy.linalg.inv(numpy.random.default_rng(0).random((2, 2))))
for projection in (None, "3d"):
    axes = plt.figure().add_subplot(projection=projection)
    axes.plot(*numpy.loadtxt("/numbers.txt"), label="$H_1$")
    axes.legend()
axes.figure.savefig("/picture.png")
plt.subplots()[1].imshow(Image.open("/picture.png"))
Image.open("/picture.png").convert("RGB").save("/picture.gif")
used = {getattr(module, "__file__", None) for module in sys.modules.values()}
matplotlib.font_manager.json_dump(matplotlib.font_manager.fontManager, "/fonts.json")
`;
const COMPILE = `
import importlib._bootstrap_external, zipfile

with zipfile.ZipFile("/sources.zip") as sources, zipfile.ZipFile("/compiled.zip", "w") as compiled:
    for name in sorted(sources.namelist()):
        if used is None or name in used:
            code = compile(sources.read(name), name, "exec", dont_inherit=True, optimize=0)
            content = importlib._bootstrap_external._code_to_timestamp_pyc(code)
            compiled.writestr(name + "c", bytes(content))
`;

process.on("uncaughtException", (error) => {
  console.error(error.message); // without the line of the minified script it came from
  process.exit(1);
});
const job = JSON.parse(await readFile(process.argv[2], "utf8"));
const python = await loadPyodide({
  // Without the columns of every instruction, which tracebacks underline, it is a third smaller.
  env: { PYTHONHASHSEED: "0", PYTHONNODEBUGRANGES: "1" },
  stderr: () => {},
  ...(job.packages && { packageCacheDir: job.folder, lockFileURL: job.lock }),
});
python.runPython("used = None");
if (job.packages) {
  await python.loadPackage(job.packages, { messageCallback: () => {} });
  python.runPython(DRAW);
  await writeFile(job.fonts, python.FS.readFile("/fonts.json"));
}
python.FS.writeFile("/sources.zip", await readFile(job.sources));
python.runPython(COMPILE);
await writeFile(job.compiled, python.FS.readFile("/compiled.zip"));
