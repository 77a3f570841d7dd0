"""Make the portraits of canim.data again, from pictures in scikit-image and matplotlib.

The same pictures and the same Pillow make the same files, byte for byte.
"""

from __future__ import annotations

import sys
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path

import matplotlib
import skimage
from PIL import Image

FOLDER = Path(__file__).parents[1] / "src/canim/data/portraits"
SIZE = (360, 400)


@dataclass(frozen=True)
class Portrait:
    """A file to write and the part of a picture to take."""

    name: str
    source: Path
    digest: str
    box: tuple[int, int, int, int]  # left, top, right, bottom


PORTRAITS = [
    Portrait(
        "collins.jpg",
        Path(skimage.__file__).parent / "data/astronaut.png",
        "88431cd9653ccd539741b555fb0a46b61558b301d4110412b5bc28b5e3ea6cb5",
        (130, 0, 310, 200),
    ),
    Portrait(
        "hopper.jpg",
        Path(matplotlib.get_data_path()) / "sample_data/grace_hopper.jpg",
        "a8ca6d734765703b09728ab47fe59f473d93ae3967fc24c7c0288c3c7adb7130",
        (110, 20, 420, 365),
    ),
]


def write(folder: Path) -> None:
    for portrait in PORTRAITS:
        found = sha256(portrait.source.read_bytes()).hexdigest()
        if found != portrait.digest:
            sys.exit(f"{portrait.source} is not the picture it was: sha256 {found}")
        with Image.open(portrait.source) as picture:
            crop = picture.convert("RGB").crop(portrait.box)
        enlarged = crop.resize(SIZE, Image.Resampling.LANCZOS)
        enlarged.save(folder / portrait.name, quality=90, subsampling=0, optimize=True)


if __name__ == "__main__":
    write(FOLDER)
