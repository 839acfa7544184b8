import ast
import pathlib
import unittest

import msc_vo


def public(names):
    return {name for name in names if not name.startswith("_")}


class Stubs(unittest.TestCase):
    """The stubs name what the module has, and nothing else."""

    def setUp(self):
        text = (pathlib.Path(msc_vo.__file__).parent / "__init__.pyi").read_text()
        body = ast.parse(text).body
        self.classes = {node.name: node for node in body if isinstance(node, ast.ClassDef)}
        self.functions = {node.name for node in body if isinstance(node, ast.FunctionDef)}

    def members(self, name):
        node = self.classes[name]
        members = public(m.name for m in node.body if isinstance(m, ast.FunctionDef))
        for base in node.bases:
            if base.id in self.classes:
                members |= self.members(base.id)
        return members

    def test_names_of_the_module(self):
        self.assertEqual(public(self.classes) | public(self.functions), public(dir(msc_vo)))

    def test_members_of_the_classes(self):
        for name in public(self.classes):
            actual = set(vars(getattr(msc_vo, name))) if name != "UnreadableImage" else set()
            self.assertEqual(self.members(name), public(actual), name)

    def test_everything_is_documented(self):
        for name in public(dir(msc_vo)):
            self.assertTrue(getattr(msc_vo, name).__doc__, name)

    def test_the_package_is_typed(self):
        self.assertTrue((pathlib.Path(msc_vo.__file__).parent / "py.typed").exists())
