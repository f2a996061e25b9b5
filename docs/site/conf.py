"""Sphinx's configuration of the site: ./run docs stages its pages with pages.py. SPDX-License-Identifier: MIT"""
project = "Knurl"
copyright = "The Knurl authors, MIT licence"
extensions = ["myst_parser", "sphinx_copybutton"]
myst_heading_anchors = 4
myst_enable_extensions = ["attrs_inline"]
html_theme = "furo"
html_title = "Knurl"
html_static_path = ["static"]
html_css_files = ["site.css"]
html_show_sphinx = False
html_copy_source = False
html_theme_options = {
    "light_css_variables": {"color-brand-primary": "#1a5fb4", "color-brand-content": "#1a5fb4"},
    "dark_css_variables": {"color-brand-primary": "#78aeed", "color-brand-content": "#78aeed"},
}
pygments_style, pygments_dark_style = "friendly", "github-dark"
highlight_language = "none"
suppress_warnings = ["misc.highlighting_failure"] # shortened code
