"""Sphinx: the site is made from a copy of the documents (contrib/utilities/site.py), in which parameters.md has been generated."""
project = 'Signorini'
copyright = '2026, the Signorini authors'
extensions = ['myst_parser']
root_doc = 'doc/index'
source_suffix = {'.md': 'markdown'}
html_theme = 'sphinx_rtd_theme'
html_theme_options = {'navigation_depth': 3}
html_copy_source = False
html_show_sphinx = False
# The site has to be read from disk, without a network.
html_theme_path = []
myst_heading_anchors = 4
suppress_warnings = ['myst.header']
exclude_patterns = []


def setup(app):
    from pygments.lexers.special import TextLexer
    for name in ('provoke', 'prm', 'output', 'geo'):
        app.add_lexer(name, TextLexer)
