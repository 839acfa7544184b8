#!/usr/bin/env python3
"""Checks that every link inside a folder resolves, in each of its Markdown files: the repository, or what
it installs.

    check_links.py ROOT         reports every broken link as file:line: message; exit status 1 if any
    check_links.py --self-test  proves on small files that broken links are found

Links to other sites are not followed. An anchor must be a heading of the file, as GitHub names it, or
an element with that id.
"""
import pathlib
import re
import sys
import urllib.parse

from markdown import NOT_IN_REPOSITORY, read_blocks

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "cmake"))
import tree_check  # noqa: E402

INLINE_CODE = re.compile(r"(`+)(.+?)\1")
# [text](target), ![text](target "title"), [name]: target
LINKS = [re.compile(r"\]\(\s*<?([^)\s>]+)>?(?:\s+\"[^\"]*\")?\s*\)"),
         re.compile(r"^\s*\[[^\]]+\]:\s+<?(\S+?)>?(?:\s|$)"),
         re.compile(r"<(?:a|img)\b[^>]*\b(?:href|src)=\"([^\"]+)\"")]
SCHEME = re.compile(r"^([a-z][a-z0-9+.-]*:|//)", re.IGNORECASE)
HEADING = re.compile(r"^ {0,3}(#{1,6})\s+(.*?)\s*#*\s*$")
ID = re.compile(r"<[a-z]+\b[^>]*\b(?:id|name)=\"([^\"]+)\"")


def documents(root):
    for path in sorted(root.rglob("*.md")):
        if not NOT_IN_REPOSITORY.match(path.relative_to(root).parts[0]):
            yield path


def text_lines(path):
    """Number and text of each line that is not in a fenced block."""
    for block in read_blocks(path.read_text()):
        if block.language is None:
            yield from enumerate(block.lines, start=block.first_line)


def slug(heading):
    """The anchor that GitHub gives a heading."""
    heading = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", heading)
    return re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")


def anchors(path):
    found = set()
    for _, line in text_lines(path):
        found.update(ID.findall(line))
        match = HEADING.match(line)
        if match:
            name = slug(match.group(2))
            candidates = [name] + [f"{name}-{i}" for i in range(1, 100)]
            found.add(next(candidate for candidate in candidates if candidate not in found))
    return found


def links(path):
    """Number of the line and target of each link."""
    for number, line in text_lines(path):
        plain = INLINE_CODE.sub("", line)
        for pattern in LINKS:
            for target in pattern.findall(plain):
                yield number, target


def problem_of(document, target, root):
    """What is wrong with a link, or None."""
    if SCHEME.match(target):
        return None
    name, _, anchor = urllib.parse.unquote(target).partition("#")
    linked = (document.parent / name).resolve() if name else document
    if root.resolve() not in (linked, *linked.parents):
        return f"{target} is outside of {root}"
    if not linked.exists():
        return f"{target}: there is no {linked.relative_to(root.resolve())}"
    if anchor and linked.suffix == ".md" and anchor not in anchors(linked):
        return f"{target}: {linked.name} has no heading #{anchor}"
    return None


def check(root):
    """Yields (path, line, message)."""
    if not any(documents(root)):
        yield pathlib.Path("."), 0, "no Markdown files"
    for document in documents(root):
        for number, target in links(document):
            problem = problem_of(document, target, root)
            if problem:
                yield document.relative_to(root), number, problem


def self_test():
    # Text of docs/a.md, a part of the only message (None: must pass).
    cases = [
        ("[b](b.md) and ![i](i.png)", None),
        ("[up](../README.md#one-two)", None),
        ("[up](../README.md#one-two-1)", None),
        ("[up](../README.md#a-b--c)", None),
        ("[own](#here)\n\n## Here", None),
        ("[own](#mark)\n<a id=\"mark\"></a>", None),
        ("[b]: b.md", None),
        ("[site](https://example.org/none) <mailto:a@b.c>", None),
        ("```sh\n[x](none.md)\n```\n`[x](none.md)`", None),
        ("[folder](.)", None),
        ("\n[x](none.md)", "docs/a.md:2: none.md: there is no docs/none.md"),
        ("![x](none.png \"title\")", "there is no docs/none.png"),
        ("[x]: none.md", "there is no docs/none.md"),
        ("<img src=\"none.png\">", "there is no docs/none.png"),
        ("[x](../README.md#one-two-2)", "README.md has no heading #one-two-2"),
        ("[x](#none)", "a.md has no heading #none"),
        ("[x](../../elsewhere)", "is outside of "),
        ("```\n# Here\n```\n[x](#here)", "a.md has no heading #here"),
    ]
    others = {"README.md": "# One two\n# One *two*\n## `a_b`, c\n# A (b)  c\n",
              "docs/b.md": "", "docs/i.png": ""}
    return tree_check.test_rules([({**others, "docs/a.md": text}, expected)
                                  for text, expected in cases], check)


if __name__ == "__main__":
    sys.exit(tree_check.main(__doc__.splitlines()[0], ".", check, self_test))
