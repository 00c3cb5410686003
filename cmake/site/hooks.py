# SPDX-License-Identifier: MIT
"""Makes the site of pages that are written to be read in the repository, too.

* Links out of docs/ lead to the reference if they name a public header, to the front page if they name the README, and are
  plain text otherwise: the site does not have what they name.
* Blocks of code that follow each other directly, in different languages, become tabs.
* What doxygen has made, in the folder that SHAFTCULL_REFERENCE names, becomes a part of the site, below reference/.
"""
import os
import re

from mkdocs.structure.files import File

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
LANGUAGES = {"cpp": "C++", "c": "C", "python": "Python"}


def doxygen_page(header):
    """The name of doxygen's page of a file."""
    return os.path.basename(header).replace("_", "__").replace(".", "_8") + ".html"


def rewritten_link(match, page):
    text, target = match.group(1), match.group(2)
    if re.match(r"[a-z]+:|#", target):
        return match.group(0)
    path, hash_mark, anchor = target.partition("#")
    folder = os.path.dirname(page.file.src_path)
    inside = os.path.normpath(os.path.join(folder, path))
    if not inside.startswith(".."):
        return match.group(0)
    of_project = os.path.relpath(os.path.join(ROOT, "docs", inside), ROOT)
    if not os.path.exists(os.path.join(ROOT, of_project)):
        raise SystemExit(f"{page.file.src_path} links to {target}, which does not exist")
    up = os.path.relpath(".", folder or ".")
    if of_project == "README.md":
        return f"[{text}]({up}/index.md)"
    if of_project.startswith("include/"):
        return f"[{text}]({up}/reference/{doxygen_page(of_project)})"
    return text


def as_tabs(match):
    blocks = re.findall(r"^```(\w+)\n(.*?)^```\n", match.group(0), re.M | re.S)
    if len({language for language, _ in blocks}) != len(blocks) or any(l not in LANGUAGES for l, _ in blocks):
        return match.group(0)
    tabs = []
    for language, code in blocks:
        lines = [f"```{language}", *code.splitlines(), "```"]
        tabs.append(f'=== "{LANGUAGES[language]}"\n\n' + "\n".join(("    " + line).rstrip() for line in lines) + "\n")
    return "\n" + "\n".join(tabs) + "\n"


def on_page_markdown(markdown, page, config, files):
    markdown = re.sub(r"^<!-- docs/examples/.* -->\n", "", markdown, flags=re.M)
    markdown = re.sub(r"(?:^```\w+\n(?:(?!```).*\n)*```\n\n?){2,}", as_tabs, markdown, flags=re.M)
    return re.sub(r"(?<!!)\[([^][]*)\]\(([^()\s]+)\)", lambda match: rewritten_link(match, page), markdown)


def on_page_content(html, page, config, files):
    html = re.sub(r"(\d) ([×%])", "\\1\u00a0\\2", html)  # a sign stays with its number
    # A table wider than a phone scrolls by itself, not the page.
    return html.replace("<table>", '<div class="wide"><table>').replace("</table>", "</table></div>")


def on_files(files, config):
    generated = os.environ["SHAFTCULL_REFERENCE"]
    above = os.path.dirname(generated)
    for folder, _, names in os.walk(generated):
        for name in names:
            path = os.path.relpath(os.path.join(folder, name), above)
            files.append(File(path, above, config["site_dir"], config["use_directory_urls"]))
    files.append(File("site.css", os.path.join(ROOT, "cmake", "site"), config["site_dir"], config["use_directory_urls"]))
    for file in list(files):
        if file.src_path.startswith("examples/"):
            files.remove(file)
    return files
