"""Keep the search index whole when only some pages are written again.

Sphinx then forgets the index entries of all other pages, and keeps words that are gone.
"""

from __future__ import annotations

from sphinx.util.index_entries import split_index_msg


def _complete(app, pagename, templatename, context, doctree):
    if pagename != "search":  # made after all others, before the index is saved
        return
    index = app.builder.indexer
    for page, entries in app.env.domains.index_domain.entries.items():
        index._index_entries.setdefault(page, sorted(set(_words(entries))))
    index._index_entries = dict(sorted(index._index_entries.items()))
    for pages_with in (index._mapping, index._title_mapping):
        for word in [word for word, pages in pages_with.items() if not pages]:
            del pages_with[word]


def _words(entries):
    for kind, value, target, main, _ in entries:
        words = split_index_msg(kind, value)
        for word in words[:1] if kind in {"see", "seealso"} else words:
            yield word, target, main


def setup(app):
    app.connect("html-page-context", _complete)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
