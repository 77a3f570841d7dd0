"""The page on Python and NumPy shows all that students write in the tasks."""

import ast
import builtins
import re


def used(program):
    """Return the functions, methods and statements that a program is made of."""
    for node in ast.walk(ast.parse(program)):
        match node:
            case ast.Attribute():
                name = ast.unparse(node)
                if re.fullmatch(r"np[.\w]+", name):
                    yield name
                elif not name.startswith("canim."):
                    yield f".{node.attr}"
            case ast.Call() if hasattr(builtins, ast.unparse(node.func)):
                yield f"{ast.unparse(node.func)}("
            case ast.AugAssign():
                yield "+="
            case ast.If() | ast.For() | ast.While() | ast.Break() | ast.Continue() | ast.Return():
                yield type(node).__name__.lower()


def test_used_names_the_parts_of_a_program():
    program = "for k in range(3):\n    x = np.linalg.norm(y.copy()) + canim.warping.f(k)\n"
    assert set(used(program)) == {"for", "range(", "np.linalg", "np.linalg.norm", ".copy"}


def test_the_page_shows_what_the_model_solutions_use(root):
    page = (root / "docs/students/numpy.md").read_text(encoding="utf-8")
    solutions = sorted((root / "tests/gallery/solutions").glob("task_*.py"))
    missing = {
        f"{name} ({path.stem})"
        for path in solutions
        for name in used(path.read_text(encoding="utf-8"))
        if name not in page
    }
    assert solutions
    assert not missing, "show it in docs/students/numpy.md"
