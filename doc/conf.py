"""Sphinx: the site is made from a copy of the documents (contrib/utilities/site.py), in which parameters.md has been generated."""
project = 'Signorini'
copyright = '2026, the Signorini authors'
extensions = ['myst_parser']
root_doc = 'doc/index'
source_suffix = {'.md': 'markdown'}
html_theme = 'sphinx_rtd_theme'
html_theme_options = {'navigation_depth': 3}
# What is typed has its own quotes and hyphens.
smartquotes = False
html_copy_source = False
html_show_sphinx = False
myst_heading_anchors = 4
suppress_warnings = ['myst.header']
exclude_patterns = []


def setup(app):
    from pygments.lexers.special import TextLexer
    for name in ('provoke', 'prm', 'output', 'geo'):
        app.add_lexer(name, TextLexer)
