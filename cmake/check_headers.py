#!/usr/bin/env python3
"""Checks that files include what they name, where their build would hide a missing include.

    check_headers.py ROOT         reports every violation as file:line: message; exit status 1 if any
    check_headers.py --self-test  tests the rule on small trees

Precompiled headers: a header that names std::vector includes <vector>, itself or through headers of
msc_vo. Covers the headers in cmake/precompiled.h, and every header in msc_vo, apps and tests. A build
without precompiled headers compiles every public header alone (tests/headers.cmake).

Files that are compiled together (CMAKE_UNITY_BUILD): a source file that names a type, a constant or a
function of a header in msc_vo or apps includes a header in which that name occurs. Covers msc_vo and apps.
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


DECLARATION = re.compile(r"^(?:(?:struct|class|enum class|enum)\s+(\w+)\b(?!;)"
                         r"|(?:inline )?constexpr [^;=({]*\b(k[A-Z]\w*)"
                         r"|(?!return|using|struct|class|enum|constexpr|#)"
                         r"[A-Za-z][\w:<>,&* ]*?[ &*]([A-Z]\w*)\()",
                         re.MULTILINE)
WORD = re.compile(r"\w+")
# What a source file defines at any level, and members that it defines or declares.
LOCAL = re.compile(r"\b(?:struct|class|enum class|enum|using|typename)\s+(\w+)"
                   r"|\bconst(?:expr)? [^;=({]*\b(k[A-Z]\w*)"
                   r"|^(?! *(?:return|throw|else|case)\b)[^\n=(]*[\w>&*:]\s*[ &*:](\w+)\(", re.MULTILINE)
# A use of a name of a namespace: not of a member, nor a name in another namespace or class.
USE = re.compile(r"(?<![\w.:>~])([A-Za-z]\w*)\b(?!::\w+::)")


def key_of(header):
    return header.split("/")[0]


@functools.lru_cache(maxsize=None)
def code_of(path):
    """The text of a file without comments and strings, by lines."""
    return COMMENTS_AND_STRINGS.sub(lambda m: re.sub(r"[^\n]", " ", m.group()),
                                    path.read_text(encoding="utf-8"))


@functools.lru_cache(maxsize=None)
def words_of(path):
    return frozenset(WORD.findall(code_of(path)))


def included(root):
    """Function from a file of the tree to the names of the headers of others that it includes, and to the
    headers of the tree, itself among them."""
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
        return others, seen

    return closure


def line_at(code, position):
    return code.count("\n", 0, position) + 1


def check_precompiled(root, closure):
    precompiled = INCLUDE.findall((root / "cmake/precompiled.h").read_text(encoding="utf-8"))
    keys = {key_of(system or local) for system, local in precompiled}
    for key in sorted(keys - set(NAMES)):
        yield pathlib.Path("cmake/precompiled.h"), 1, f"no names of <{key}> in check_headers.py"
    for top in ("msc_vo", "apps", "tests"):
        for path in sorted((root / top).rglob("*.h")):
            have, _ = closure(path)
            for key in sorted(keys & set(NAMES) - have):
                match = re.search(NAMES[key], code_of(path))
                if match:
                    yield (path.relative_to(root), line_at(code_of(path), match.start()),
                           f"names {match.group()} without an include of <{key}>")


def check_together(root, closure):
    def files(suffix):
        return sorted(path for top in ("msc_vo", "apps") for path in (root / top).rglob("*" + suffix))
    declared = {}
    for path in files(".h"):
        for names in DECLARATION.findall(code_of(path)):
            declared.setdefault("".join(names), path)
    for path in files(".cc"):
        code = code_of(path)
        known = {"".join(names) for names in LOCAL.findall(code)}
        known = known.union(*(words_of(header) for header in closure(path)[1] - {path}))
        for match in USE.finditer(code):
            name = match.group(1)
            if name in declared and name not in known:
                known.add(name)
                yield (path.relative_to(root), line_at(code, match.start()),
                       f"names {name} without an include of {declared[name].relative_to(root)}")


def check_tree(root):
    """All violations in the tree as (path, line, message)."""
    closure = included(root)
    yield from check_precompiled(root, closure)
    yield from check_together(root, closure)


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
              "msc_vo/map/b.h": "#include <string>\n",
              "msc_vo/map/c.h": "int Sum(int x);\nconstexpr int kMax = 1;\nstruct Other {};\n",
              "msc_vo/map/d.h": '#include "msc_vo/map/c.h"\n'}
    # Contents of msc_vo/map/a.cc.
    sources = [
        ("int F() {\n  return Sum(1);\n}\n", "a.cc:2: names Sum without an include of msc_vo/map/c.h"),
        ("int F() { return kMax; }\n", "names kMax"),
        ("void F(const Other& other);\n", "names Other"),
        ('#include "msc_vo/map/d.h"\nint F() { return Sum(kMax); }\n', None),
        ("struct Other;\nvoid F(const Other& other);\n", None),
        ("int Sum(int x) {\n  return x;\n}\nint F() { return Sum(1); }\n", None),
        ("int F(const A& a) { return a.Sum(1) + B::Sum(2); }\n", None),
    ]
    return tree_check.test_rules([({**others, "msc_vo/map/a.h": contents}, expected)
                                  for contents, expected in cases] +
                                 [({**others, "msc_vo/map/a.cc": contents}, expected)
                                  for contents, expected in sources], check_tree)


if __name__ == "__main__":
    sys.exit(tree_check.main(__doc__.splitlines()[0], "msc_vo", check_tree, self_test))
