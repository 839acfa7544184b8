#!/usr/bin/env python3
"""Prints the folder of Python packages below an installation prefix: install_folder.py PREFIX."""
import sys
import sysconfig


def main():
    prefix = sys.argv[1].rstrip("/")
    schemes = sysconfig.get_scheme_names()
    # Debian's Python has one folder for its packages and another one for those of the administrator.
    if prefix == "/usr/local" and "posix_local" in schemes:
        base, scheme = "/usr", "posix_local"
    elif "deb_system" in schemes:
        base, scheme = prefix, "deb_system"
    else:
        base, scheme = prefix, "posix_prefix"
    folder = sysconfig.get_path("platlib", scheme, vars={"base": base, "platbase": base})
    print(folder[len(prefix):].lstrip("/"))


if __name__ == "__main__":
    main()
