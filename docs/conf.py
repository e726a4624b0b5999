"""Sphinx's settings for the site that scripts/docs builds: out/site/html."""
import os

import docutils.nodes

project = "Abut"
release = version = os.environ["ABUT_VERSION"]  # scripts/site reads it from CMakeLists.txt
html_title = f"Abut {release}"
html_copy_source = False
html_show_copyright = False
html_use_index = False         # pages have no entries of an index

extensions = ["myst_parser"]
myst_enable_extensions = ["dollarmath"]
myst_dmath_allow_digits = False  # $5 or 5$ is no formula
myst_heading_anchors = 4       # headings are linked to as on GitHub
html_math_renderer = "katex"   # below
suppress_warnings = ["myst.header"]  # a page may leave out a level of headings
highlight_language = "none"    # of code that names no language
smartquotes = False            # --option keeps its two hyphens

html_theme = "furo"
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_theme_options = {"sidebar_hide_name": False}


def formula(tag):
    """Writes a formula as it stands; docs/site/formulas.js sets it in the browser."""
    def visit(translator, node):
        translator.body.append(f'<{tag} class="math notranslate nohighlight">{translator.encode(node.astext())}</{tag}>')
        raise docutils.nodes.SkipNode
    return visit, None


def add_katex(app, page, template, context, tree):
    if app.env.get_domain("math").has_equations(page):
        app.add_css_file("katex/katex.min.css")  # scripts/site copies Debian's KaTeX
        for script in ("katex/katex.min.js", "formulas.js"):
            app.add_js_file(script, defer="defer")


def setup(app):
    app.add_html_math_renderer("katex", formula("span"), formula("div"))
    app.connect("html-page-context", add_katex)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
