"""What `import canim` and its parts load."""

from __future__ import annotations

import importlib
import subprocess
import sys

import pytest

import canim

# What takes longer to load than all that `import canim` needs.
HEAVY = {
    "typing",
    "numpy",
    "scipy",
    "matplotlib",
    "PIL",
    "pyvista",
    "vtk",
    "skimage",
    "joblib",
}


def loaded_by(statement):
    """Return the modules that a fresh Python holds after one statement."""
    program = f"{statement}\nimport sys\nprint(*sys.modules)"
    run = subprocess.run([sys.executable, "-c", program], capture_output=True, check=True)
    return set(run.stdout.decode().split())


def test_import_canim_is_light():
    loaded = loaded_by("import canim") - loaded_by("pass")
    assert "canim" in loaded
    assert not loaded & HEAVY
    assert not any(name.startswith("canim.") for name in loaded)


def test_interpolation_needs_numpy_alone():
    loaded = loaded_by("import canim\ncanim.interpolation.lerp(1, 2, 0.5)")
    assert "canim.interpolation" in loaded
    assert loaded & HEAVY == {"typing", "numpy"}


def test_check_of_a_curve_needs_no_scipy():
    loaded = loaded_by(
        "import canim\ncanim.check('1.1', hermite_basis=canim.interpolation.hermite_basis)"
    )
    assert "canim.checks.task_1_1" in loaded
    assert not loaded & {"scipy", "matplotlib", "canim.checks.task_2_1"}


@pytest.mark.parametrize("name", [name for name in canim.__all__ if name != "check"])
def test_parts_are_loaded_on_first_use(name):
    assert getattr(canim, name) is importlib.import_module(f"canim.{name}")
    assert name in dir(canim)


def test_check_is_the_function_of_the_checks():
    assert canim.check is importlib.import_module("canim.checks").check


def test_other_names_are_missing_as_usual():
    with pytest.raises(AttributeError, match="module 'canim' has no attribute 'interpolate'"):
        _ = canim.interpolate


def test_every_public_name_of_a_block_is_there():
    assert sorted(canim.interpolation.__all__) == canim.interpolation.__all__
    for name in canim.interpolation.__all__:
        value = getattr(canim.interpolation, name)
        assert value is canim.interpolation.HERMITE_MATRIX or value.__doc__
