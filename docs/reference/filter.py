#!/usr/bin/env python3
"""Shows Doxygen a header as it would like to read it, line for line; the headers keep their plain comments.

    filter.py include/lumis/lights/shapes.hpp

A comment on lines of its own documents the declaration that it stands over; one behind a declaration documents that. The
first comment of a file is the file's, and that of a type without its own. What a file declares belongs to the group of its room.
"""

import itertools
import re
import sys
from pathlib import Path

# A comment's a < b is no tag, nor is its <header>.
LESS = re.compile(r"(?<!`)<(?=\w)")
COMMENT = re.compile(r"^( *)// ?(.*)$")
OPENS = re.compile(r"^namespace lumis::LUMIS_ISA(\S*) {$")
CLOSES = re.compile(r"^}  // namespace lumis::LUMIS_ISA")
TYPE = re.compile(r"^ *(class|struct|union|enum)\b")
# What may stand over a declaration, or end one, at the depth of a namespace.
NO_DECLARATION = re.compile(r"^ *(template\b|requires\b|namespace\b|#|//|public:|private:|protected:|[})\]]|$)")


def declares_members(lines):
    """For each line, whether a comment there is one on a declaration: in a namespace or a class, not in a function."""
    found, in_type = [], True
    for line in lines:
        depth = len(line) - len(line.lstrip(" "))
        if depth == 0 and TYPE.match(line):
            in_type = True
        elif depth == 0 and not NO_DECLARATION.match(line):
            in_type = False
        found.append(depth == 0 or (depth == 4 and in_type))
    return found


def defines_type(lines):
    """Whether a declaration that starts with these lines is that of a type, and not of one that is only announced."""
    head = next((line for line in lines if not re.match(r"template\b| {4}|#", line)), "")
    return TYPE.match(head) and not head.endswith(";")


def documenting(comment):
    return LESS.sub(r"\<", comment.replace("//", "///", 1))


def filtered(text, room):
    lines = text.split("\n")
    declaring = declares_members(lines)
    about = " ".join(documenting(line)[4:] for line in itertools.takewhile(COMMENT.match, lines))
    for i, line in enumerate(lines):
        comment = COMMENT.match(line)
        if OPENS.match(line):
            lines[i] = OPENS.sub(rf"namespace lumis\1 {{ /** \\addtogroup {room} */ /** @{{ */", line)
        elif CLOSES.match(line):
            lines[i] = "/** @} */ }"
            if i + 1 < len(lines) and "std::" in "".join(lines[i + 1:]):  # specialisations are not ours to document
                return "\n".join(lines[:i + 1])
        elif line == "#pragma once" and i > 0:
            lines[:i] = [documenting(above) for above in lines[:i]]
            lines[i] = "/// \\file"
        elif not comment and line.strip() and not line.lstrip().startswith(("#", "}")) and i > 0 and declaring[i]:
            above = i - 1
            while above >= 0 and COMMENT.match(lines[above]) and not lines[above].lstrip().startswith("///"):
                lines[above] = documenting(lines[above])
                above -= 1
            lines[i] = re.sub(r"(;|,|\{\}) +// ", r"\1  ///< ", line)
            if not lines[i - 1].strip() and defines_type(lines[i:]):
                lines[i] = f"/** {about} */ {line}"
    return "\n".join(lines)


def main():
    path = Path(sys.argv[1])
    text = path.read_text()
    if path.suffix == ".hpp":
        parts = path.parts[path.parts.index("include") + 1:]
        text = filtered(text, parts[1].removesuffix(".hpp"))
    sys.stdout.write(text)


if __name__ == "__main__":
    main()
