"""How Sphinx makes the course site. What is our own is in `_ext/`."""

import sys
import warnings
from pathlib import Path

import canim

sys.path.insert(0, str(Path(__file__).parent / "_ext"))

# What renders faces needs so much memory that joblib starts its worker anew; it may.
warnings.filterwarnings("ignore", "A worker stopped while some jobs")

project = "canim"
author = "The canim contributors"
project_copyright = author
version = release = canim.__version__
language = "en"

extensions = [
    "sphinx.ext.autodoc",
    "numpydoc",
    "sphinx_gallery.gen_gallery",
    "myst_nb",
    "sphinx_design",
    "sphinxcontrib.bibtex",
    "sphinx_copybutton",
    "sphinx.ext.githubpages",  # which else leaves out all that begins with "_"
    # ours
    "run_here",
    "formulas",
    "pictures",
    "notebooks",
    "freshness",
    "search_index",
    "task_page",
    "run_page",
    "task_cards",
    "known_mistakes",
    "words",
    "architecture",
    "downloads",
    "take_away",
    "page_head",
    "security",
    "styles",
]

exclude_patterns = ["_build", "node_modules", "gallery/**/*.ipynb", "gallery/**/images"]
# A block whose page is index.md does without the one that sphinx-gallery makes of its header.
pages = Path(__file__).parents[1].glob("gallery/*/index.md")
exclude_patterns += [f"gallery/{page.parent.name}/index.rst" for page in pages]
nitpicky = True
nitpick_ignore = []

# -- Look ------------------------------------------------------------------
html_theme = "furo"
html_title = "Computer animation with canim"
html_favicon = "_static/favicon.svg"
html_static_path = ["_static"]
templates_path = ["_templates"]
html_css_files = ["course.css", "run.css"]
html_theme_options = {
    "top_of_page_buttons": [],
    "light_css_variables": {
        "color-brand-primary": "#0b5c99",
        "color-brand-content": "#0b5c99",
        "color-brand-visited": "#0b5c99",
    },
    "dark_css_variables": {
        "color-brand-primary": "#7cc0f2",
        "color-brand-content": "#7cc0f2",
        "color-brand-visited": "#7cc0f2",
    },
}
html_copy_source = False
html_show_sourcelink = False
html_scaled_image_link = False
html_domain_indices = False
html_math_renderer = "katex"
pygments_style = "a11y-high-contrast-light"
pygments_dark_style = "a11y-high-contrast-dark"

# -- Text ------------------------------------------------------------------
myst_enable_extensions = ["amsmath", "colon_fence", "deflist", "dollarmath"]
nb_execution_mode = "force"
nb_execution_show_tb = True  # an error is a warning, which ends a build with -W
nb_execution_timeout = 120
nb_output_stderr = "remove-warn"
nb_merge_streams = True
bibtex_bibfiles = ["references.bib"]
bibtex_reference_style = "author_year"
copybutton_exclude = ".linenos, .gp, .go"

# -- API -------------------------------------------------------------------
autodoc_typehints = "none"
autodoc_member_order = "groupwise"
numpydoc_show_class_members = False
numpydoc_xref_param_type = False

# -- Gallery ---------------------------------------------------------------
sphinx_gallery_conf = {
    "examples_dirs": "../gallery",
    "gallery_dirs": "gallery",
    "filename_pattern": r"[\\/]task_",
    "subsection_order": [f"../gallery/{block}" for block in canim.checks.BLOCKS],
    "within_subsection_order": "task_page.ByNumber",
    "copyfile_regex": r"index\.md$",
    "parallel": 2,
    "reset_modules": ("matplotlib", "pictures.reset"),
    "image_scrapers": ("pictures.scrape",),
    "doc_module": ("canim",),
    "capture_repr": (),
    "css": (),
    "download_all_examples": False,
    "min_reported_time": 1e9,
    "show_signature": False,
    "write_computation_times": False,
}
