"""Reads Markdown as far as the tests of the documentation need it."""
import dataclasses
import re

# Entries of the root that are not part of the repository: builds, results, caches.
NOT_IN_REPOSITORY = re.compile(r"^(build.*|out|\.git|\.cache)$")

FENCE = re.compile(r"^\s*(`{3,}|~{3,})\s*([\w+-]*)")


@dataclasses.dataclass
class Block:
    """A fenced block of code, or a stretch of text between two of them."""
    first_line: int  # of its contents, from 1
    language: object  # a string; None: text
    lines: list


def read_blocks(text):
    """Splits Markdown into stretches of text and fenced blocks, in order, without the fences."""
    blocks = [Block(1, None, [])]
    fence = None  # that closes the block
    for number, line in enumerate(text.splitlines(), start=1):
        match = FENCE.match(line)
        if fence is None and match:
            fence = match.group(1)
            blocks.append(Block(number + 1, match.group(2), []))
        elif fence is not None and line.strip() == fence:
            fence = None
            blocks.append(Block(number + 1, None, []))
        else:
            blocks[-1].lines.append(line)
    return blocks
