"""Put the starters that are made from the pages in gallery/ into wheel and sdist."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface


class StarterHook(BuildHookInterface):  # type: ignore[type-arg]
    """Writes src/canim/starters/ anew before anything is packed."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        root = Path(self.root)
        sys.path.insert(0, str(root / "docs/_ext"))
        import starter

        of = starter.release(root)
        folder = root / "src/canim/starters"
        folder.mkdir(exist_ok=True)
        for old in folder.iterdir():
            old.unlink()
        for page in starter.pages(root):
            text = starter.script(page, of)
            (folder / f"{page.name}.py").write_text(text, encoding="utf-8", newline="\n")
