"""Sphinx's settings for the site that scripts/docs builds: out/site/html."""
import os

project = "Abut"
release = version = os.environ["ABUT_VERSION"]  # scripts/site reads it from CMakeLists.txt
html_title = f"Abut {release}"
html_copy_source = False
html_show_copyright = False
html_use_index = False         # pages have no entries of an index

extensions = ["myst_parser"]
myst_heading_anchors = 4       # headings are linked to as on GitHub
suppress_warnings = ["myst.header"]  # a page may leave out a level of headings
highlight_language = "none"    # of code that names no language
smartquotes = False            # --option keeps its two hyphens

html_theme = "furo"
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_theme_options = {"sidebar_hide_name": False}
