"""Where the site and the project's files are: written once, and true everywhere or nowhere."""

from __future__ import annotations

import importlib.util
import re
from importlib import metadata

import pytest
import starter

SITE, REPOSITORY = "https://example.org/course/", "https://example.org/files/"
RELATIVE = re.compile(r"\]\((?!https?://|#)")


@pytest.fixture(scope="module")
def hook(root):
    spec = importlib.util.spec_from_file_location("hatch_build", root / "hatch_build.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture
def project(root, tmp_path):
    """Make a project with these addresses; return its folder."""

    def make(site, repository):
        (tmp_path / "src/canim").mkdir(parents=True)
        (tmp_path / "src/canim/__init__.py").write_text('__version__ = "1"\n', encoding="utf-8")
        (tmp_path / "README.md").write_text(
            (root / "README.md").read_text(encoding="utf-8"), encoding="utf-8"
        )
        (tmp_path / "pyproject.toml").write_text(
            f'[tool.canim]\nsite = "{site}"\nrepository = "{repository}"\n', encoding="utf-8"
        )
        return tmp_path

    return make


@pytest.mark.parametrize("repository", ["", REPOSITORY])
@pytest.mark.parametrize("site", ["", SITE])
def test_the_package_names_the_addresses_there_are(hook, project, site, repository):
    found = {}
    hook.AddressHook(str(project(site, repository)), {}).update(found)
    page = found["readme"]["text"]
    assert found["urls"] == {
        **({"Homepage": site} if site else {}),
        **({"Source": repository} if repository else {}),
    }
    assert not RELATIVE.search(page)
    assert ("(https://example.org/course/_static/canim.png)" in page) == bool(site)
    assert page.count("![") == bool(site)
    licence = "[LICENSE](https://example.org/files/blob/HEAD/LICENSE)" if repository else "LICENSE"
    assert f"MIT, see {licence}." in page


def test_links_that_are_whole_stay_as_they_are(hook):
    text = "[a](https://example.org) [b](#part) ![c](https://example.org/c.png)"
    assert hook.package_page(text, SITE, REPOSITORY) == text


def test_the_readme_begins_with_what_canim_is_for_those_who_use_it(root):
    text = (root / "README.md").read_text(encoding="utf-8")
    headings = re.findall(r"^## (.*)", text, re.M)
    assert headings == ["For students", "For teachers", "For developers", "Licence and citation"]
    assert "nox" not in text[: text.index("## For teachers")]
    assert RELATIVE.search(text), "links within the repository are for those who have it"


def test_the_package_brings_every_licence(root):
    installed = metadata.metadata("canim")
    assert installed["License-Expression"] == "MIT AND CC0-1.0 AND LicenseRef-Public-Domain"
    brought = set(installed.get_all("License-File"))
    data = root / "src/canim/data"
    assert brought == {
        "LICENSE",
        *(path.relative_to(root).as_posix() for path in data.glob("*/*.md")),
    }
    texts = [root / name for name in brought]
    assert any("CC0 1.0 Universal" in path.read_text(encoding="utf-8") for path in texts)
    assert any("public domain" in path.read_text(encoding="utf-8") for path in texts)
    assert not RELATIVE.search(installed.get_payload())


def test_the_citation_names_the_repository_if_there_is_one(root):
    citation = (root / "CITATION.cff").read_text(encoding="utf-8")
    found = re.search(r"^repository-code: (.*)$", citation, re.M)
    assert (found[1] if found else "") == starter.release(root).repository


@pytest.mark.parametrize("wrong", ["example.org/files", "git@example.org:files", "https://", "x"])
def test_what_is_no_address_is_refused(project, wrong):
    with pytest.raises(ValueError, match=r"^pyproject\.toml: repository must be an address, not"):
        starter.release(project("", wrong))


def test_what_is_no_address_of_a_site_is_refused(project):
    with pytest.raises(ValueError, match="site must be an address"):
        starter.release(project("example.org", ""))
