"""What programs that check files of the source tree share: command line, output, test of the rules."""
import argparse
import pathlib
import sys
import tempfile


def main(description, marker, violations_of, self_test):
    """Returns the exit status. `marker`: a path in the root. `violations_of`: from the root to
    (path, line, message)."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("root", nargs="?", type=pathlib.Path)
    parser.add_argument("--self-test", action="store_true")
    arguments = parser.parse_args()
    if arguments.self_test:
        return self_test()
    if arguments.root is None or not (arguments.root / marker).exists():
        parser.error(f"ROOT must be the folder that holds {marker}")
    violations = list(violations_of(arguments.root.resolve()))
    for path, line, message in violations:
        print(f"{path}:{line}: {message}", file=sys.stderr)
    return 1 if violations else 0


def test_rules(cases, violations_of):
    """Checks a small tree for each case: the contents of its files by path, and a part of the message
    that must be the only one (None: there must be none). Returns the exit status."""
    for files, expected in cases:
        with tempfile.TemporaryDirectory() as directory:
            root = pathlib.Path(directory).resolve()
            for path, contents in files.items():
                (root / path).parent.mkdir(parents=True, exist_ok=True)
                (root / path).write_text(contents)
            found = [f"{path}:{line}: {message}" for path, line, message in violations_of(root)]
        if not (not found if expected is None else len(found) == 1 and expected in found[0]):
            print(f"self-test: {files!r}: expected {expected!r}, got {found}", file=sys.stderr)
            return 1
    print(f"self-test: all {len(cases)} cases as expected")
    return 0
