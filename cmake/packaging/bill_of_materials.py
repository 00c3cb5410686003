#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes which libraries the files of a release contain and link, as SPDX 2.3: FOLDER/shaftcull-VERSION.spdx.json.

    bill_of_materials.py SOURCES VERSION COMMIT FOLDER

Licences are those of docs/third-party.md, versions those of the Debian packages that cmake/dependencies.cmake names. Fails if a
Debian package in FOLDER depends on a library that the page does not list. SOURCE_DATE_EPOCH is the time of the document.
"""

import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys
from datetime import datetime, timezone

# Compiled into the npm package; no CMake list looks for them.
WEB = {
    "libc++": ("Apache-2.0 WITH LLVM-exception", "libc++-19-dev-wasm32"),
    "compiler-rt": ("Apache-2.0 WITH LLVM-exception", "libclang-rt-19-dev-wasm32"),
    "wasi-libc": ("Apache-2.0 WITH LLVM-exception AND MIT", "wasi-libc"),
}
# What every program of Debian depends on, and this project's own packages.
BASE = re.compile(r"libc6|libstdc\+\+6|libgcc-s1|python3|python3-numpy|libshaftcull.*")


def rows(sources):
    """Rows of the table of docs/third-party.md: name, licence, used by, how."""
    page = (sources / "docs/third-party.md").read_text()
    found = re.findall(r"^\| ([^|]+) \| ([^|]+) \| ([^|]+) \| ([^|]+) \|$", page, re.MULTILINE)
    return [row for row in found if row[0] != "name"]


def expression(name, licence):
    """The licence of a row as SPDX has it: "MIT, with …" is MIT."""
    words = re.split(r",| for ", licence)[0].replace(" or ", " OR ")
    if not re.fullmatch(r"[A-Za-z0-9.-]+( OR [A-Za-z0-9.-]+)*", words):
        sys.exit(f"docs/third-party.md: the licence of {name} is no SPDX expression: {licence}")
    return words


def debian_packages(sources):
    """By the names that CMake looks for, the Debian packages that have them."""
    text = (sources / "cmake/dependencies.cmake").read_text()
    found = dict(re.findall(r"shaftcull_dependency\((\w+) [^)]*?DEBIAN ([\w.+-]+)", text))
    return {**found, "pybind11": "pybind11-dev"}


def version_of(package):
    """Debian's version of a package of this machine."""
    asked = subprocess.run(["dpkg-query", "-W", "-f=${Version}", package], capture_output=True, text=True, check=False)
    if asked.returncode != 0:
        sys.exit(f"{package} is not installed, so its version is not known")
    return asked.stdout


def parts_of(file):
    """Which parts of the project a file of the release has, in words of the page."""
    if file.name.startswith("libshaftcull-dev"):
        return []  # headers alone
    if file.name.startswith("libshaftcull"):
        return ["the library"]
    if file.suffix == ".whl":
        return ["the library", "the Python module"]
    if file.name.startswith("python3-"):
        return ["the Python module"]
    return ["the program"] if file.suffix == ".deb" else []


def is_in_release(user):
    """Whether a word of the column "used by" means something that is released."""
    return not re.search(r"`batch`|Windows|benchmarks|tests|=ON", user)


def check_dependencies(file, names):
    depends = subprocess.run(["dpkg-deb", "-f", str(file), "Depends"], capture_output=True, text=True, check=True).stdout
    for package in re.findall(r"(?:^|[,|]) *([a-z0-9][a-z0-9.+-]*)", depends):
        if not BASE.fullmatch(package) and not any(name.lower() in package for name in names):
            sys.exit(f"{file.name} depends on {package}, of which docs/third-party.md has no row")


def package(identifier, name, version, licence, **more):
    return {
        "SPDXID": f"SPDXRef-{re.sub('[^A-Za-z0-9.-]', '-', identifier)}",
        "name": name,
        "versionInfo": version,
        "downloadLocation": "NOASSERTION",
        "filesAnalyzed": False,
        "licenseConcluded": licence,
        "licenseDeclared": licence,
        "copyrightText": "NOASSERTION",
        **more,
    }


def main():
    sources, version, commit, folder = pathlib.Path(sys.argv[1]), sys.argv[2], sys.argv[3], pathlib.Path(sys.argv[4])
    table = rows(sources)
    debian = debian_packages(sources)
    out = folder / f"shaftcull-{version}.spdx.json"
    files = sorted(file for file in folder.iterdir() if file not in (out, folder / "SHA256SUMS"))
    described = {}
    relations = set()

    def add(name, licence, debian_name):
        described[name] = package(f"library-{name}", name, version_of(debian_name), licence)
        return described[name]["SPDXID"]

    released = []
    for file in files:
        checksum = {"algorithm": "SHA256", "checksumValue": hashlib.sha256(file.read_bytes()).hexdigest()}
        item = package(f"file-{file.name}", "shaftcull", version, "MIT", packageFileName=file.name, checksums=[checksum])
        released.append(item)
        relations.add(("SPDXRef-DOCUMENT", "DESCRIBES", item["SPDXID"]))
        if file.suffix == ".deb":
            check_dependencies(file, [row[0] for row in table])
        for name, licence, users, how in table:
            users = [user for user in users.split(";") if is_in_release(user)]
            if not any(part in user for part in parts_of(file) for user in users):
                continue
            library = add(name, expression(name, licence), debian[name])
            for word, relation in (("compiled in", "CONTAINS"), ("linked", "DYNAMIC_LINK")):
                if word in how:
                    relations.add((item["SPDXID"], relation, library))
        if file.suffix == ".tgz":
            for name, (licence, debian_name) in WEB.items():
                relations.add((item["SPDXID"], "CONTAINS", add(name, licence, debian_name)))

    created = datetime.fromtimestamp(int(os.environ["SOURCE_DATE_EPOCH"]), timezone.utc)
    document = {
        "spdxVersion": "SPDX-2.3",
        "dataLicense": "CC0-1.0",
        "SPDXID": "SPDXRef-DOCUMENT",
        "name": f"shaftcull-{version}",
        "documentNamespace": f"urn:shaftcull:{version}:{commit}",
        "creationInfo": {
            "created": created.strftime("%Y-%m-%dT%H:%M:%SZ"),
            "creators": [f"Tool: bill_of_materials.py-{version}", "Organization: shaftcull contributors"],
        },
        "packages": released + [described[name] for name in sorted(described)],
        "relationships": [
            {"spdxElementId": one, "relationshipType": kind, "relatedSpdxElement": other} for one, kind, other in sorted(relations)
        ],
    }
    out.write_text(json.dumps(document, indent=1) + "\n")


main()
