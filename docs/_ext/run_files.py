"""What the Python in the page loads: Pyodide and its packages, made small and quick to start.

Programs are compiled beforehand, by the very Python that will run them; tests, sources and
what draws anything but PNG are left out. The same files give the same bytes.
"""

from __future__ import annotations

import gzip
import hashlib
import io
import json
import re
import shutil
import subprocess
import tempfile
import zipfile
from email import message_from_bytes
from functools import partial
from pathlib import Path

import pyodide
from formulas import NODE

SITE_PACKAGES = "/lib/python3.12/site-packages/"
FONTS = "matplotlib/fontlist.json"  # it takes a second to make
ENVIRONMENT = {"MPLBACKEND": "agg"}

# The packages served, and what canim and its starters do not need of each.
DROPPED = {
    "numpy": r"numpy/_pyinstaller/|/include/|f2py/src/",
    "pillow": r"PIL/(_webp|_imagingft)\.",
    "contourpy": r"contourpy/util/",
    "cycler": None,
    "kiwisolver": None,
    "packaging": None,
    "pyparsing": r"pyparsing/diagram/",
    "python-dateutil": r"dateutil/zoneinfo/",
    "six": None,
    "matplotlib": (
        r"matplotlib/(testing|sphinxext)/|mpl_toolkits/axisartist/|pylab\.py"
        r"|mpl-data/(sample_data|images|plot_directive|fonts/(afm|pdfcorefonts))/"
        r"|ttf/(DejaVu(Serif|SansMono-|Sans-BoldO)|STIX\w+(Bol|Ita))"
        r"|backends/(qt_|web_|_backend_(gtk|tk|pdf_ps)|backend_(cairo|gtk|macosx|nbagg|pdf|pgf|ps|qt"
        r"|tk|webagg|wx|ttconv))|/_ttconv\."
    ),
    "openblas": None,
    "scipy": r"scipy/(misc|datasets)/|\.pyx$",
}
PACKAGES = tuple(DROPPED)
NEVER_NEEDED = re.compile(r"/tests?/|\.(pyi|pxd|h|a|c|lib|typed)$|\.dist-info/(RECORD|direct_url)")
NOT_FOR_PNG = {"fonttools", "pytz", "matplotlib-pyodide"}

# What is loaded only where the text of a program asks for it: what it is part of, and which
# files it holds; below, what asks for it.
PARTS = {
    "scipy-more": ("scipy", r"scipy/(?!(linalg|_lib|sparse|spatial|special|constants)/)\w+/"),
    "canim-face": ("canim", r"canim/data/face/"),
}
NEEDS = {
    "scipy": r"\bscipy\b|\bwarping\b|\bcheck\(\s*[\"']2\.",
    "scipy-more": r"\bscipy\b",
    "canim-face": r"\bface\(|\bsave_expressions\b|\bcheck\(\s*[\"']3\.[45]",
}
FIRST = ("numpy", "matplotlib", "canim")

COMPILE = pyodide.DOCS / "_ext/compile.mjs"
KEPT = pyodide.DOCS / "_build/run"
# Of Python's own: other processes, servers, mail, and the alphabets of old files.
NOT_IN_A_PAGE = (
    r"^(multiprocessing|wsgiref|xmlrpc)/|^(_pyio|ftplib|imaplib|mailbox|nntplib|pdb|pickletools"
    r"|poplib|smtplib|telnetlib)\.py|^encodings/(big5|cp(?!437|1252)|euc_|gb|hz|iso(2022|8859_"
    r"(?!1\.|15))|johab|koi8|kz|mac_|ptcp|shift|tis)"
)
OLDEST_ZIP_TIME = (1980, 1, 1, 0, 0, 0)
STANDARD_LIBRARY = "python_stdlib.zip"
LIST = "pyodide-lock.json"
KNOWN = "run.json"  # what the scripts in the page know of the files


def make(wheel):
    """Return the folder of all that a run loads, but the worker; `wheel` is canim's."""
    theirs = _kept("theirs", [pyodide.LOCK_SHA256], _theirs)
    ours = _kept("canim", [hashlib.sha256(wheel.read_bytes()).hexdigest()], partial(_ours, wheel))
    return _kept("all", [theirs.name, ours.name], partial(_all, theirs, ours))


def transferred(path):
    """Return how many bytes travel: servers compress scripts and wasm, the rest is compressed."""
    content = path.read_bytes()
    if path.suffix in {".js", ".json", ".wasm"}:
        content = gzip.compress(content, mtime=0)
    return len(content)


def licences(folder):
    """Return name, version and licence of all that the folder holds, from their metadata."""
    core = json.loads((pyodide.CORE / "package.json").read_bytes())
    yield "Pyodide", core["version"], core["license"]
    listed = json.loads((folder / LIST).read_text(encoding="utf-8"))
    yield "Python", listed["info"]["python"], "PSF-2.0"
    for package in listed["packages"].values():
        if package["package_type"] == "shared_library":
            yield "OpenBLAS", package["version"], "BSD-3-Clause"  # its archive has no metadata
        elif package["name"] not in PARTS:
            with zipfile.ZipFile(folder / package["file_name"]) as wheel:
                (name,) = (name for name in wheel.namelist() if name.endswith("info/METADATA"))
                yield package["name"], package["version"], _licence(wheel.read(name))


def _licence(metadata):
    fields = message_from_bytes(metadata)
    kinds = [line.split(" :: ") for line in fields.get_all("Classifier", [])]
    named = [kind[-1] for kind in kinds if kind[0] == "License"]
    return fields["License-Expression"] or ", ".join(named)


def _kept(name, made_from, build):
    """Return the folder that `build` fills; it is kept while what it is made from is the same."""
    digest = hashlib.sha256(Path(__file__).read_bytes() + COMPILE.read_bytes())
    digest.update("\0".join(made_from).encode())
    folder = KEPT / f"{name}-{digest.hexdigest()[:12]}"
    if not folder.exists():
        KEPT.mkdir(parents=True, exist_ok=True)
        for old in KEPT.glob(f"{name}-*"):
            shutil.rmtree(old)
        with tempfile.TemporaryDirectory(dir=KEPT) as part:
            new = Path(part, "new")
            new.mkdir()
            build(new)
            new.rename(folder)
    return folder


def _theirs(folder):
    """Write what canim needs, trimmed, and with bytecode for what a picture takes."""
    found = pyodide.find(PACKAGES)
    contents = {found[name].name: _members(found[name], DROPPED[name]) for name in PACKAGES}
    whole, holds = PARTS["scipy-more"]
    contents["scipy-more.zip"] = _split(contents[found[whole].name], holds)
    _write(folder, contents)
    _list_packages(folder)
    library = _members(pyodide.CORE / STANDARD_LIBRARY, NOT_IN_A_PAGE)
    fonts = _compile([(SITE_PACKAGES, contents), ("/lib/python312.zip/", {"": library})], folder)
    drawn = contents[found["matplotlib"].name]
    drawn[FONTS] = _bytes(_served(fonts, drawn))
    _write(folder, contents | {STANDARD_LIBRARY: library})


def _ours(wheel, folder):
    """Write canim, all of it as bytecode."""
    contents = {wheel.name: _members(wheel, r"^canim/starters/")}
    contents["canim-face.zip"] = _split(contents[wheel.name], PARTS["canim-face"][1])
    _compile([(SITE_PACKAGES, contents)])
    _write(folder, contents)


def _all(theirs, ours, folder):
    for made in (theirs, ours):
        shutil.copytree(made, folder, dirs_exist_ok=True)
    for name in ("pyodide.asm.js", "pyodide.asm.wasm"):
        shutil.copyfile(pyodide.CORE / name, folder / name)
    _list_packages(folder)
    (folder / KNOWN).write_bytes(_bytes(_known(folder)))


def _known(folder):
    """Return what the scripts in the page know of the files."""
    packages = json.loads((folder / LIST).read_bytes())["packages"]
    files = {
        path.name: (path.stat().st_size, transferred(path), _hash(path))
        for path in folder.iterdir()
    }
    sizes = {name: travels for name, (_, travels, _) in files.items()}

    def closure(names):
        return {*names}.union(*(closure(packages[name]["depends"]) for name in names))

    def transfer(names):
        return sum(sizes.pop(packages[name]["file_name"], 0) for name in closure(names))

    first = transfer(FIRST)
    more = {name: transfer([name]) for name in NEEDS}
    core = sum(sizes.values())
    return {
        "env": ENVIRONMENT,
        "first": FIRST,
        "needs": NEEDS,
        "bytes": {"first": core + first, **more},
        "files": files,
    }


def _write(folder, contents):
    for name, members in contents.items():
        (folder / name).write_bytes(_zip(members))


def _list_packages(folder):
    """Write Pyodide's list anew, with just the packages in the folder."""
    whole = pyodide.lock()
    packages = {name: whole["packages"][name] for name in PACKAGES}
    plain = {"install_dir": "site", "package_type": "package", "imports": []}
    for wheel in folder.glob("canim-*.whl"):
        packages["canim"] = plain | {
            "name": "canim",
            "version": wheel.name.split("-")[1],
            "file_name": wheel.name,
            "depends": ["matplotlib", "numpy", "pillow"],
        }
    for part, (belongs_to, _) in PARTS.items():
        if belongs_to in packages:
            packages[part] = plain | {
                "name": part,
                "version": packages[belongs_to]["version"],
                "file_name": f"{part}.zip",
                "depends": [belongs_to],
            }
    for package in packages.values():
        package["depends"] = [name for name in package["depends"] if name not in NOT_FOR_PNG]
        package["sha256"] = _hash(folder / package["file_name"])
    (folder / LIST).write_bytes(_bytes(whole | {"packages": packages}))


def _hash(path):
    return hashlib.sha256(path.read_bytes()).hexdigest()


def _bytes(data):
    return json.dumps(data, indent=1, sort_keys=True).encode()


def _members(archive, dropped=None):
    """Return what an archive holds, by name, but for what nobody needs."""
    unwanted = re.compile(dropped) if dropped else None
    with zipfile.ZipFile(archive) as packed:
        return {
            name: packed.read(name)
            for name in sorted(packed.namelist())
            if not (name.endswith("/") or NEVER_NEEDED.search(name))
            and not (unwanted and unwanted.search(name))
        }


def _split(members, holds):
    """Take what matches out of the members and return it."""
    taken = re.compile(holds)
    return {name: members.pop(name) for name in list(members) if taken.match(name)}


def _zip(members):
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w") as archive:
        for name in sorted(members):
            member = zipfile.ZipInfo(name, OLDEST_ZIP_TIME)
            member.external_attr = 0o644 << 16
            archive.writestr(member, members[name], zipfile.ZIP_DEFLATED, compresslevel=9)
    return packed.getvalue()


def _compile(places, folder=None):
    """Put bytecode in the place of programs; return matplotlib's list of fonts, if there is one.

    ``places`` are folders in the page and what is in them: members by archive, then by name.
    With a ``folder`` of packages, only what it takes to draw with them is compiled.
    """
    programs = {
        where + name: (members, name)
        for where, contents in places
        for members in contents.values()
        for name in members
        if name.endswith(".py")
    }
    with tempfile.TemporaryDirectory() as scratch:
        job = {key: str(Path(scratch, key)) for key in ("sources", "compiled", "fonts")}
        if folder:
            job |= {"folder": str(folder), "lock": str(folder / LIST), "packages": PACKAGES}
        with zipfile.ZipFile(job["sources"], "w") as sources:
            for path, (members, name) in programs.items():
                sources.writestr(zipfile.ZipInfo(path), members[name])
        Path(scratch, "job.json").write_bytes(_bytes(job))
        subprocess.run([NODE, COMPILE, Path(scratch, "job.json")], check=True)
        with zipfile.ZipFile(job["compiled"]) as compiled:
            for made in compiled.namelist():
                members, name = programs[made.removesuffix("c")]
                del members[name]
                members[f"{name}c"] = compiled.read(made)
        return json.loads(Path(job["fonts"]).read_bytes()) if folder else None


def _served(fonts, members):
    """Return the list of fonts, less those that are left out."""
    served = [
        font for font in fonts["ttflist"] if f"matplotlib/mpl-data/{font['fname']}" in members
    ]
    return fonts | {"afmlist": [], "ttflist": sorted(served, key=lambda font: font["fname"])}
