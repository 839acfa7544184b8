#!/usr/bin/env python3
"""Runs the ```sh blocks of Markdown files, so that the commands of the documentation work.

    run_shell_blocks.py --root ROOT --command MSC_VO FILE.md ...
    run_shell_blocks.py --self-test

The blocks of a file run in order in a scratch folder that looks like ROOT with a build in it: links to
every entry of ROOT except builds, results and caches, and MSC_VO as build/apps/msc_vo and on the
PATH. Each block starts there anew, with HOME in the scratch folder, and must end with exit status 0.

Not run are lines that build, install or download (SKIPPED below), and blocks below a line
    <!-- not run: REASON -->
Both are reported. Exit status 1 if any block fails.
"""
import argparse
import os
import pathlib
import re
import subprocess
import sys
import tempfile

from markdown import NOT_IN_REPOSITORY, read_blocks

# The first word of a line -> why it is not run.
SKIPPED = {
    **dict.fromkeys(["apps/demo.sh", "tests/run.sh", "cmake", "ctest", "ninja"], "builds"),
    **dict.fromkeys(["data/make_room.sh"], "writes into the repository"),
    **dict.fromkeys(["cmake/install_packages.sh", "sudo", "apt", "apt-get", "pip", "pip3"],
                    "installs"),
    **dict.fromkeys(["git", "wget", "curl", "tar", "unzip"], "downloads"),
    **dict.fromkeys(["evo_ape", "evo_rpe", "evo_traj"], "belongs to another project"),
    **dict.fromkeys(["docker", "podman"], "needs a container"),
    **dict.fromkeys(["xdg-open", "firefox"], "opens a window"),
}
MARK = re.compile(r"<!--\s*not run:\s*(.*?)\s*-->\s*$")
BLOCK_SECONDS = 300


def logical_lines(lines):
    """Joins lines that a backslash continues."""
    joined = ""
    for line in lines:
        joined += line
        if line.endswith("\\"):
            joined += "\n"
        else:
            yield joined
            joined = ""
    if joined:
        yield joined


def first_word(line):
    """The program that a line runs; variables set before it do not count."""
    words = [word for word in line.split() if not re.match(r"^[A-Za-z_]\w*=", word)]
    return words[0].removeprefix("./") if words else ""


def split_block(lines):
    """The lines to run, and pairs of a line that is not run and the reason."""
    run, skipped = [], []
    for line in logical_lines(lines):
        reason = SKIPPED.get(first_word(line))
        if reason:
            skipped.append((line.strip(), reason))
        elif line.strip():
            run.append(line)
    return run, skipped


def shell_blocks(text):
    """Pairs of a ```sh block and the reason not to run it (None: run it)."""
    before = ""  # last line of text above the block
    for block in read_blocks(text):
        if block.language is None:
            filled = [line for line in block.lines if line.strip()]
            before = filled[-1] if filled else ""
        else:
            if block.language in ("sh", "bash", "shell"):
                mark = MARK.search(before)
                yield block, mark.group(1) if mark else None
            before = ""


def make_scratch(scratch, root, command):
    for entry in sorted(root.iterdir()):
        if not NOT_IN_REPOSITORY.match(entry.name):
            (scratch / entry.name).symlink_to(entry)
    (scratch / "build" / "apps").mkdir(parents=True)
    (scratch / "build" / "apps" / "msc_vo").symlink_to(command)
    (scratch / ".home").mkdir()


def run_lines(lines, scratch):
    """Exit status and output of a block."""
    environment = dict(os.environ, HOME=str(scratch / ".home"),
                       PATH=f"{scratch / 'build' / 'apps'}{os.pathsep}{os.environ['PATH']}")
    try:
        result = subprocess.run(["bash", "-euo", "pipefail", "-c", "\n".join(lines)], cwd=scratch,
                                env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                stderr=subprocess.STDOUT, timeout=BLOCK_SECONDS, check=False)
    except subprocess.TimeoutExpired as expired:
        output = (expired.output or b"").decode(errors="replace")
        return 1, f"{output}\nnot finished after {BLOCK_SECONDS} s"
    return result.returncode, result.stdout.decode(errors="replace")


def run_document(document, root, command):
    """Runs the blocks of a file in a scratch folder of its own; whether all passed."""
    passed = True
    with tempfile.TemporaryDirectory() as directory:
        scratch = pathlib.Path(directory).resolve()
        make_scratch(scratch, root, command)
        for block, reason in shell_blocks(document.read_text()):
            where = f"{document.relative_to(root)}:{block.first_line}"
            if reason is not None:
                print(f"{where}: block not run: {reason}")
                continue
            lines, skipped = split_block(block.lines)
            for line, why in skipped:
                print(f"{where}: line not run, it {why}: {line}")
            status, output = run_lines(lines, scratch)
            print(f"{where}: {len(lines)} lines, exit status {status}", flush=True)
            if status != 0:
                passed = False
                print("\n".join(["  | " + line for line in lines] + [output]))
    return passed


def self_test():
    # Text of a file, whether it must pass, a part of what must be printed.
    cases = [
        ("```sh\ntest -e data/x && echo 1 > out.txt\n```\n\n```sh\ntest -e out.txt\n```", True,
         "a.md:6: 1 lines, exit status 0"),
        ("```sh\nfalse\ntrue\n```", False, "a.md:2: 2 lines, exit status 1"),
        ("```sh\nfalse | true\n```", False, "exit status 1"),
        ("```sh\nmsc_vo one two\nbuild/apps/msc_vo\n```", True, "2 lines, exit status 0"),
        ("```sh\necho no-such-output; exit 3\n```", False, "no-such-output"),
        ("```sh\ntests/run.sh && false\n./apps/demo.sh  # builds\nJOBS=2 cmake \\\n  --build x\n```",
         True, "line not run, it builds: JOBS=2 cmake"),
        ("Text\n<!-- not run: needs a file -->\n```sh\nfalse\n```", True,
         "block not run: needs a file"),
        ("<!-- not run: one -->\n```sh\nfalse\n```\n```sh\nfalse\n```", False, "exit status 1"),
        ("```text\nfalse\n```\n```cpp\nfalse;\n```", True, ""),
        ("```sh\ntest \"$(pwd)\" = \"$(cd ~/.. && pwd)\"\n```", True, "exit status 0"),
        ("```sh\ntest ! -e build/other\n```", True, "exit status 0"),
    ]
    for text, must_pass, expected in cases:
        with tempfile.TemporaryDirectory() as directory:
            root = pathlib.Path(directory).resolve()
            for folder in ("data", "build/other"):
                (root / folder).mkdir(parents=True)
            (root / "data" / "x").write_text("")
            (root / "a.md").write_text(text)
            arguments = [sys.executable, __file__, "--root", root, "--command", "/bin/true",
                         root / "a.md"]
            result = subprocess.run(arguments, stdout=subprocess.PIPE, check=False)
            output = result.stdout.decode()
            if (result.returncode == 0) != must_pass or expected not in output:
                print(f"self-test: {text!r}: exit status {result.returncode}\n{output}",
                      file=sys.stderr)
                return 1
    print(f"self-test: all {len(cases)} cases as expected")
    return 0


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("documents", nargs="*", type=pathlib.Path)
    parser.add_argument("--root", type=pathlib.Path)
    parser.add_argument("--command", type=pathlib.Path)
    parser.add_argument("--self-test", action="store_true")
    arguments = parser.parse_args()
    if arguments.self_test:
        return self_test()
    if not (arguments.root and arguments.command and arguments.documents):
        parser.error("--root, --command and a file are needed")
    root = arguments.root.resolve()
    passed = [run_document(document.resolve(), root, arguments.command.resolve())
              for document in arguments.documents]
    return 0 if all(passed) else 1


if __name__ == "__main__":
    sys.exit(main())
