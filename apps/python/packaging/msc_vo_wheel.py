# SPDX-License-Identifier: BSD-3-Clause
# SPDX-FileCopyrightText: 2026 the msc_vo authors
"""Wheels (PEP 427) of the Python module, with the metadata of pyproject.toml and CMakeLists.txt."""
import base64
import hashlib
import re
import sys
import sysconfig
import zipfile

# The time of all files in a wheel, so that the same files give the same wheel.
TIME = (1980, 1, 1, 0, 0, 0)


def version(root):
    text = (root / "CMakeLists.txt").read_text(encoding="utf-8")
    return re.search(r"project\(msc_vo VERSION ([0-9.]+)", text).group(1)


def dist_info(root):
    return f"msc_vo-{version(root)}.dist-info"


def tag():
    """Interpreter, its binary interface, and platform: the module is linked for one of each."""
    python = f"cp{sys.version_info[0]}{sys.version_info[1]}"
    if sys.implementation.name != "cpython":
        raise SystemExit(f"msc_vo is built for CPython, not for {sys.implementation.name}")
    platform = re.sub("[-.]", "_", sysconfig.get_platform())
    return f"{python}-{python}{getattr(sys, 'abiflags', '')}-{platform}"


def project(root):
    """The table [project] of pyproject.toml: strings, and lists of strings on several lines."""
    text = (root / "pyproject.toml").read_text(encoding="utf-8")
    table = re.search(r"^\[project\]\n(.*?)(?=^\[|\Z)", text, re.MULTILINE | re.DOTALL).group(1)
    entries = re.findall(r"^([a-z-]+) = (\[.*?\]|\{.*?\}|\".*?\")$", table, re.MULTILINE | re.DOTALL)
    return {name: re.findall(r'"([^"]*)"', value) for name, value in entries}


def metadata(root):
    values = project(root)
    lines = ["Metadata-Version: 2.1", f"Name: {values['name'][0]}", f"Version: {version(root)}",
             f"Summary: {values['description'][0]}", f"Author: {values['authors'][0]}",
             f"License: {values['license'][0]}", f"Keywords: {','.join(values['keywords'])}"]
    lines += [f"Classifier: {classifier}" for classifier in values["classifiers"]]
    lines += [f"Requires-Dist: {name}" for name in values["dependencies"]]
    lines += [f"Requires-Python: {values['requires-python'][0]}", "License-File: LICENSE",
              "Description-Content-Type: text/markdown"]
    return "\n".join(lines) + "\n\n" + (root / values["readme"][0]).read_text(encoding="utf-8")


def metadata_files(root):
    """The files of the folder .dist-info but RECORD, by name."""
    marks = ["Wheel-Version: 1.0", f"Generator: msc_vo {version(root)}", "Root-Is-Purelib: false",
             f"Tag: {tag()}"]
    return {"METADATA": metadata(root).encode(), "WHEEL": ("\n".join(marks) + "\n").encode(),
            "LICENSE": (root / "LICENSE").read_bytes()}


def write(root, package, directory):
    """Writes the wheel of the files in the folder `package` and returns its name."""
    files = {f"msc_vo/{path.name}": path.read_bytes() for path in sorted(package.iterdir())
             if path.is_file()}
    for name, content in metadata_files(root).items():
        files[f"{dist_info(root)}/{name}"] = content
    record = f"{dist_info(root)}/RECORD"
    files[record] = "".join([*(record_line(name, files[name]) for name in files),
                             f"{record},,\n"]).encode()
    name = f"msc_vo-{version(root)}-{tag()}.whl"
    with zipfile.ZipFile(directory / name, "w", zipfile.ZIP_DEFLATED) as archive:
        for path, content in files.items():
            entry = zipfile.ZipInfo(path, TIME)
            entry.external_attr = (0o755 if path.endswith(".so") else 0o644) << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, content)
    return name


def record_line(name, content):
    digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
    return f"{name},sha256={digest},{len(content)}\n"
