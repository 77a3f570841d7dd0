"""What wheel and sdist hold beside the package: starters, addresses, the README as a page."""

from __future__ import annotations

import re
import sys
from pathlib import Path
from types import ModuleType
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface
from hatchling.metadata.plugin.interface import MetadataHookInterface

PICTURE = re.compile(r"!\[([^]]*)\]\((?!\w+:)docs/([^)]+)\)\n*")
LINK = re.compile(r"(?<!!)\[([^]]*)\]\((?!\w+:|#)([^)]+)\)")


def _starter(root: str) -> ModuleType:
    sys.path.insert(0, str(Path(root, "docs/_ext")))
    import starter

    return starter


def package_page(readme: str, site: str, repository: str) -> str:
    """Return the README for a package index, where no address may be relative.

    A picture is on the site, a file in the repository. Without the one or the other, the
    picture goes, and of a link the words stay.
    """
    picture = rf"![\1]({site.rstrip('/')}/\2)\n\n" if site else ""
    link = rf"[\1]({repository.rstrip('/')}/blob/HEAD/\2)" if repository else r"\1"
    return LINK.sub(link, PICTURE.sub(picture, readme))


class AddressHook(MetadataHookInterface):
    """Fills in what follows from the addresses in ``[tool.canim]``."""

    def update(self, metadata: dict[str, Any]) -> None:
        of = _starter(self.root).release(Path(self.root))
        text = Path(self.root, "README.md").read_text(encoding="utf-8")
        page = package_page(text, of.site, of.repository)
        metadata["readme"] = {"content-type": "text/markdown", "text": page}
        addresses = {"Homepage": of.site, "Source": of.repository}
        metadata["urls"] = {name: address for name, address in addresses.items() if address}


class StarterHook(BuildHookInterface):  # type: ignore[type-arg]
    """Writes src/canim/starters/ anew before anything is packed."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        root = Path(self.root)
        starter = _starter(self.root)
        of = starter.release(root)
        folder = root / "src/canim/starters"
        folder.mkdir(exist_ok=True)
        for old in folder.iterdir():
            old.unlink()
        for page in starter.pages(root):
            text = starter.script(page, of)
            (folder / f"{page.name}.py").write_text(text, encoding="utf-8", newline="\n")
