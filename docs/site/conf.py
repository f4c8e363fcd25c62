"""The pages of the repository as a site that can be read and searched offline: `make site`."""
from pathlib import Path
from urllib.parse import unquote

from docutils import nodes
from pygments.lexers.special import TextLexer

ROOT = Path(__file__).resolve().parents[2]

project = "perifrac"
author = "the perifrac authors"
copyright = f"{author}, BSD-3-Clause"
release = next(line.split()[2] for line in (ROOT / "CMakeLists.txt").read_text(encoding="utf-8").splitlines()
               if line.startswith("project(perifrac VERSION"))

extensions = ["myst_parser"]
root_doc = "docs/index"
include_patterns = ["README.md", "CHANGELOG.md", "CONTRIBUTING.md", "docs/**.md", "app/**README.md",
                    "core/**README.md", "coupling/**README.md", "modules/**README.md"]
exclude_patterns = ["build", "runs", ".git"]
myst_heading_anchors = 4

html_theme = "furo"
html_title = f"perifrac {release}"
html_copy_source = False


def link_beside_pages(app, environment, reference, content):
    """Links that pages make for readers of the repository: to a folder, shown as its name here, and to an
    anchor of the page's own HTML. Whatever else leads nowhere stays a warning, and so an error."""
    page = environment.doc2path(reference["refdoc"])
    target = unquote(reference["reftarget"])
    if target.startswith("#") and f'id="{target[1:]}"' in Path(page).read_text(encoding="utf-8"):
        return nodes.reference("", "", *content.children, refuri=target, internal=True)
    if (Path(page).parent / target).is_dir():
        return nodes.inline("", "", *content.children)
    return None


def setup(app):
    app.add_lexer("mermaid", TextLexer)
    app.connect("missing-reference", link_beside_pages)
