"""On a task's page, the theory ends with a link to the page of symbols and words, and a word
in bold letters that is explained there leads to it.
"""

from __future__ import annotations

from docutils import nodes
from sphinx import addnodes
from sphinx.util.nodes import make_refnode

GLOSSARY = "students/glossary"


def find(text, terms):
    """Return the term of the glossary that a bold text names, or None.

    Plural and singular are the same, and "bilinear" is "bilinear interpolation" if no other
    term begins with it.
    """
    word = text.lower().replace("’", "'").strip(" .,:").removeprefix("the ")
    for name in (word, word.removesuffix("s"), word.removesuffix("es")):
        if name in terms:
            return name
    longer = [term for term in terms if term.startswith(f"{word} ")]
    return longer[0] if len(longer) == 1 else None


def _end_theory(app, doctree):
    if not app.env.docname.startswith("gallery/"):
        return
    for section in doctree.findall(nodes.section):
        if section.next_node(nodes.title).astext() == "Theory":
            section += nodes.paragraph("", "What the letters and words mean: ", _to_glossary())
            # The page is written again when a word is new.
            app.env.note_dependency(str(app.env.doc2path(GLOSSARY)))


def _to_glossary():
    return addnodes.pending_xref(
        "",
        nodes.inline("", "Symbols and words"),
        refdomain="std",
        reftype="doc",
        reftarget=f"/{GLOSSARY}",
        refexplicit=True,
        refwarn=True,
    )


def _link(app, doctree, docname):
    if not docname.startswith("gallery/"):
        return
    standard = app.env.domains.standard_domain
    objects = standard.objects.items()
    terms = {name.lower(): place for (kind, name), place in objects if kind == "term"}
    seen = set()
    for bold in list(doctree.findall(nodes.strong)):
        term = find(bold.astext(), terms)
        if term is None or term in seen or isinstance(bold.parent, nodes.reference):
            continue
        seen.add(term)
        page, label = terms[term]
        bold.replace_self(make_refnode(app.builder, docname, page, label, bold.deepcopy()))


def setup(app):
    app.connect("doctree-read", _end_theory)
    app.connect("doctree-resolved", _link)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
