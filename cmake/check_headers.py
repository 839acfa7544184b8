#!/usr/bin/env python3
"""Checks that headers include what they name of the precompiled headers, which would hide a missing include.

    check_headers.py ROOT         reports every violation as file:line: message; exit status 1 if any
    check_headers.py --self-test  tests the rule on small trees

A header that names std::vector includes <vector>, itself or through headers of msc_vo. Covers the headers
in cmake/precompiled.h, and every header in msc_vo, apps and tests. A build without precompiled headers
compiles every public header alone (tests/headers.cmake).
"""
import functools
import pathlib
import re
import sys

import tree_check

STD = r"\bstd::(%s)\b"
# Precompiled header -> pattern of the names that need it. Headers of one library that include each other
# share a name.
NAMES = {
    "algorithm": STD % "(all|any|none)_of|binary_search|clamp|copy_n|count_if|equal_range|fill(_n)?|find_if|"
                       "is_sorted|(lower|upper)_bound|(min|max|minmax)_element|nth_element|partial_sort|"
                       "partition|remove_if|reverse|rotate|(stable_)?sort|transform|unique",
    "array": STD % "array",
    "cmath": STD % "a?(cos|sin|tan)|atan2|cbrt|ceil|exp|floor|hypot|is(finite|nan)|log(10|2|1p)?|l?l?round|"
                   "pow|sqrt",
    "cstdint": r"\bu?int(8|16|32|64)_t\b",
    "functional": STD % "function|hash|c?ref",
    "limits": STD % "numeric_limits",
    "map": STD % "(multi)?map",
    "memory": STD % "(unique|shared|weak)_ptr|make_(unique|shared)",
    "optional": STD % "optional|nullopt",
    "set": STD % "(multi)?set",
    "stdexcept": STD % "(runtime|logic)_error|invalid_argument|out_of_range",
    "string": STD % "w?string|to_string|sto[dil]",
    "utility": STD % "pair|exchange|forward|(make_)?(index|integer)_sequence(_for)?",
    "vector": STD % "vector",
    "Eigen": r"\bEigen::",
    "opencv2": r"\bcv::",
}
COMMENTS_AND_STRINGS = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"', re.DOTALL)
INCLUDE = re.compile(r'^\s*#\s*include\s*(?:<([^>]+)>|"([^"]+)")', re.MULTILINE)


def key_of(header):
    return header.split("/")[0]


def included(root):
    """Function from a file of the tree to the names of the headers of others that it includes."""
    @functools.lru_cache(maxsize=None)
    def direct(path):
        others, own = set(), set()
        for system, local in INCLUDE.findall(path.read_text(encoding="utf-8")):
            name = system or local
            if (root / name).is_file():
                own.add(root / name)
            else:
                others.add(key_of(name))
        return others, own

    def closure(path):
        others, pending, seen = set(), [path], {path}
        while pending:
            more, own = direct(pending.pop())
            others |= more
            pending += own - seen
            seen |= own
        return others

    return closure


def check_tree(root):
    """All violations in the tree as (path, line, message)."""
    precompiled = INCLUDE.findall((root / "cmake/precompiled.h").read_text(encoding="utf-8"))
    keys = {key_of(system or local) for system, local in precompiled}
    for key in sorted(keys - set(NAMES)):
        yield pathlib.Path("cmake/precompiled.h"), 1, f"no names of <{key}> in check_headers.py"
    closure = included(root)
    for top in ("msc_vo", "apps", "tests"):
        for path in sorted((root / top).rglob("*.h")):
            code = COMMENTS_AND_STRINGS.sub(lambda m: re.sub(r"[^\n]", " ", m.group()),
                                            path.read_text(encoding="utf-8"))
            have = closure(path)
            for key in sorted(keys & set(NAMES) - have):
                match = re.search(NAMES[key], code)
                if match:
                    line = code.count("\n", 0, match.start()) + 1
                    yield (path.relative_to(root), line,
                           f"names {match.group()} without an include of <{key}>")


def self_test():
    # Contents of msc_vo/map/a.h, a part of the message that must be the only one (None: must pass).
    cases = [
        ("std::vector<int> F();\n", "names std::vector without an include of <vector>"),
        ("inline double F(double x) { return std::sqrt(x); }\n", "<cmath>"),
        ("#include <vector>\nstd::vector<Eigen::Vector3d> F();\n", "<Eigen>"),
        ("void F(const cv::Mat& image);\n", "<opencv2>"),
        ("#include <vector>\nstd::vector<int> F();\n", None),
        ("#include <Eigen/Core>\nEigen::Vector3d F();\n", None),
        ('#include "msc_vo/map/b.h"\nstd::string F();\n', None),
        ("// As a std::vector.\nvoid F();\n", None),
    ]
    others = {"cmake/precompiled.h": "#include <cmath>\n#include <string>\n#include <vector>\n"
                                     "#include <Eigen/Core>\n#include <opencv2/core.hpp>\n",
              "msc_vo/map/b.h": "#include <string>\n"}
    return tree_check.test_rules([({**others, "msc_vo/map/a.h": contents}, expected)
                                  for contents, expected in cases], check_tree)


if __name__ == "__main__":
    sys.exit(tree_check.main(__doc__.splitlines()[0], "msc_vo", check_tree, self_test))
