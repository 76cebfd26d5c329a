"""What mkdocs.yml leaves to Python: pages and files from outside docs/, and formulas.

README.md becomes the site's first page. Links lead to the site's pages, to copies of the project's
files, or, to folders, nowhere. Formulas become MathML, which browsers draw by themselves.
"""

import os
import re
from pathlib import Path

import latex2mathml.converter
from mkdocs.structure.files import File

ROOT = Path(__file__).resolve().parent.parent
PAGES = {"README.md": "index.md", "CHANGELOG.md": "CHANGELOG.md", "SECURITY.md": "SECURITY.md"}
LINK = re.compile(r"(!?\[(?:[^\]\[]|\[[^\]]*\])*\])\(([^)\s]+)\)")
FORMULA = re.compile(r"\$\$(.+?)\$\$", re.DOTALL)
FENCE = re.compile(r"^(```.*?^```)", re.DOTALL | re.MULTILINE)


def on_files(files, config):
    for name, page in PAGES.items():
        files.append(File.generated(config, page, content=(ROOT / name).read_text()))
    for name in sorted(linked_files()):
        files.append(File.generated(config, "source/" + name, abs_src_path=str(ROOT / name)))
    return files


def on_page_markdown(markdown, page, config, files):
    source = source_of(page.file.src_uri)
    return outside_examples(
        markdown, lambda text: with_formulas(LINK.sub(lambda link: relinked(link, source), text))
    )


def source_of(page):
    """The project's file that a page of the site is made of."""
    for name, site_page in PAGES.items():
        if site_page == page:
            return name
    return "docs/" + page


def site_name_of(name):
    """Where the site has a file of the project."""
    if name in PAGES:
        return PAGES[name]
    return name[len("docs/"):] if name.startswith("docs/") else "source/" + name


def outside_examples(markdown, change):
    parts = FENCE.split(markdown)
    return "".join(part if part.startswith("```") else change(part) for part in parts)


def target_of(link, source):
    """What a link leads to: a name in the project and an anchor, or None if it leads elsewhere."""
    target = link.group(2)
    if re.match(r"[a-z]+:|#", target):
        return None
    name, mark, anchor = target.partition("#")
    return os.path.normpath(os.path.join(os.path.dirname(source), name)), mark + anchor


def relinked(link, source):
    found = target_of(link, source)
    if found is None:
        return link.group(0)
    name, anchor = found
    if (ROOT / name).is_dir():
        return link.group(1).strip("![]")
    here = os.path.dirname(site_name_of(source))
    return f"{link.group(1)}({os.path.relpath(site_name_of(name), here or '.')}{anchor})"


def linked_files():
    """Files outside docs/ that pages link."""
    names = set()
    for source in [*PAGES, *(str(p.relative_to(ROOT)) for p in (ROOT / "docs").rglob("*.md"))]:
        for link in LINK.finditer(FENCE.sub("", (ROOT / source).read_text())):
            found = target_of(link, source)
            if found is None or found[0] in PAGES or found[0].startswith("docs/"):
                continue
            if (ROOT / found[0]).is_file():
                names.add(found[0])
    return names


def with_formulas(text):
    return FORMULA.sub(
        lambda found: latex2mathml.converter.convert(found.group(1).strip(), display="block"), text
    )
