"""Writes earshot_VERSION_ARCHITECTURE.spdx.json, the bill of materials (SPDX 2.3) of the Debian packages in a folder.

It names every file of every package with its checksums, what the packages need where they are installed, what of others
is compiled into them (by their copyright files), and what they were built with: the group "build" of
toolchains/packages.txt with what these packages need, the compiler down to the last, in this machine's versions. Of
another architecture also its cross compiler, and the libraries of its sysroot. Same packages, same bytes.

usage: bill_of_materials.py FOLDER VERSION SECONDS [SYSROOT]     SECONDS since 1970: the time of its making
"""

from __future__ import annotations

import datetime
import hashlib
import io
import json
import re
import subprocess
import sys
import tarfile
from pathlib import Path
from typing import Any, NamedTuple

WANTED = Path(__file__).resolve().parents[1] / "packages.txt"
COMPILER = "g++"
LICENCES = {  # Debian's short names in SPDX's words
    "BSD-2-clause": "BSD-2-Clause",
    "BSD-3-clause": "BSD-3-Clause",
    "BSL-1.0": "BSL-1.0",
    "Expat": "MIT",
    "LGPL-2.1+": "LGPL-2.1-or-later",
    "MPL-2.0": "MPL-2.0",
}
LICENCE, COPYRIGHT = "Apache-2.0", "2026 The Earshot authors"
Element = dict[str, Any]


class Installed(NamedTuple):
    """A package of Debian's that is on this machine, or in a sysroot."""

    name: str
    version: str
    architecture: str
    needs: list[str]


def output_of(*command: str | Path) -> bytes:
    return subprocess.run([str(word) for word in command], check=True, capture_output=True).stdout


def identifier(*words: str) -> str:
    return "SPDXRef-" + re.sub(r"[^A-Za-z0-9.-]+", "-", "-".join(words))


def relation(element: str, kind: str, other: str) -> Element:
    return {"spdxElementId": element, "relationshipType": kind, "relatedSpdxElement": other}


def checksums(content: bytes, *names: str) -> list[Element]:
    return [
        {"algorithm": name, "checksumValue": hashlib.new(name, content, usedforsecurity=False).hexdigest()}
        for name in names
    ]


def contents_of(deb: Path) -> list[tuple[str, bytes]]:
    """Every regular file that it installs, in the order of their names."""
    with tarfile.open(fileobj=io.BytesIO(output_of("dpkg-deb", "--fsys-tarfile", deb))) as tree:
        streams = [(member.name, tree.extractfile(member)) for member in tree.getmembers() if member.isfile()]
        return sorted((name, stream.read()) for name, stream in streams if stream is not None)


def included_in(contents: list[tuple[str, bytes]], package: str) -> dict[str, str]:
    """Debian's packages that are compiled into it, with their licences, by its copyright file ("Files: NAME/*")."""
    text = dict(contents).get(f"./usr/share/doc/{package}/copyright", b"").decode()
    found = re.findall(r"^Files: ([a-z0-9.+-]+)/\*\n(?:Copyright:.*\n(?: .*\n)*)License: (.*)$", text, re.MULTILINE)
    return {name: LICENCES[licence] for name, licence in found}


def files_of(contents: list[tuple[str, bytes]], package: str, licence: str) -> list[Element]:
    """LICENCE is that of what is compiled."""
    return [
        {
            "SPDXID": identifier("File", package, hashlib.sha256(name.encode()).hexdigest()),
            "fileName": name,
            "checksums": checksums(content, "SHA1", "SHA256"),
            "licenseConcluded": licence if content.startswith((b"\x7fELF", b"!<arch>")) else LICENCE,
            "licenseInfoInFiles": ["NOASSERTION"],
            "copyrightText": COPYRIGHT,
        }
        for name, content in contents
    ]


def verification_code(files: list[Element]) -> str:
    """SPDX 2.3, 7.9: SHA1 of the sorted SHA1 of all files."""
    sums = sorted(file["checksums"][0]["checksumValue"] for file in files)
    return hashlib.sha1("".join(sums).encode(), usedforsecurity=False).hexdigest()


def of_debian(name: str, version: str | None, architecture: str) -> Element:
    """A package of Debian's, which is not ours."""
    element: Element = {
        "SPDXID": identifier("Debian", name, architecture),
        "name": name,
        "downloadLocation": "NOASSERTION",
        "filesAnalyzed": False,
        "licenseConcluded": "NOASSERTION",
        "licenseDeclared": "NOASSERTION",
        "copyrightText": "NOASSERTION",
        "supplier": "Organization: Debian",
        "externalRefs": [
            {
                "referenceCategory": "PACKAGE-MANAGER",
                "referenceType": "purl",
                "referenceLocator": f"pkg:deb/debian/{name}{'@' + version if version else ''}?arch={architecture}",
            }
        ],
    }
    if version:
        element["versionInfo"] = version
    return element


def of_ours(deb: Path, fields: dict[str, str], files: list[Element], licence: str) -> Element:
    return {
        "SPDXID": identifier("Package", fields["Package"]),
        "name": fields["Package"],
        "versionInfo": fields["Version"],
        "packageFileName": deb.name,
        "downloadLocation": "NOASSERTION",
        "filesAnalyzed": True,
        "packageVerificationCode": {"packageVerificationCodeValue": verification_code(files)},
        "checksums": checksums(deb.read_bytes(), "SHA256"),
        "licenseConcluded": licence,
        "licenseInfoFromFiles": ["NOASSERTION"],
        "licenseDeclared": LICENCE,
        "copyrightText": COPYRIGHT,
        "supplier": "Organization: Earshot",
    }


def fields_of(deb: Path) -> dict[str, str]:
    lines = output_of("dpkg-deb", "--field", deb, "Package", "Version", "Architecture", "Depends").decode().splitlines()
    return dict(line.split(": ", 1) for line in lines)


def names_in(depends: str) -> list[str]:
    """Of "libc6 (>= 2.36), a:any | b" the names, alternatives apart."""
    return [re.split(r"[ :(]", name.strip())[0] for name in re.split(r"[,|]", depends) if name.strip()]


def installed_here() -> dict[str, Installed]:
    form = "${Package}\t${Version}\t${Architecture}\t${db:Status-Status}\t${Pre-Depends}, ${Depends}\n"
    lines = [line.split("\t") for line in output_of("dpkg-query", "--show", "--showformat", form).decode().splitlines()]
    here = output_of("dpkg", "--print-architecture").decode().strip()
    return {
        name: Installed(name, version, architecture, names_in(needs))
        for name, version, architecture, status, needs in lines
        if status == "installed" and architecture in (here, "all")
    }


def installed_in(sysroot: Path) -> dict[str, Installed]:
    """As toolchains/sysroot wrote it."""
    lines = [line.split() for line in (sysroot / "packages").read_text().splitlines()]
    return {name: Installed(name, version, architecture, []) for name, version, architecture in lines}


def wanted(group: str) -> list[str]:
    lines = [line.split("#")[0].split() for line in WANTED.read_text().splitlines()]
    return sorted({words[1] for words in lines if len(words) >= 2 and words[0] == group})


def with_needs(names: list[str], here: dict[str, Installed], levels: int) -> dict[str, Installed]:
    """These packages and what they need, so many times over: g++ alone is a name, and g++-12 what compiles."""
    found = {name: here[name] for name in names if name in here}
    for _ in range(levels):
        found |= {name: here[name] for one in found.values() for name in one.needs if name in here}
    return found


def built_with(here: dict[str, Installed], sysroot: Path | None) -> list[Installed]:
    """Without the libraries of a sysroot, in whose place this machine's have no part."""
    names = wanted("build")
    if sysroot:
        names = sorted({*names, *wanted(sysroot.name)} - {*wanted("sysroot"), COMPILER})
    missing = sorted(name for name in names if name not in here)
    if missing:
        raise SystemExit(f"bill_of_materials.py: is not installed: {', '.join(missing)} (toolchains/setup build)")
    compilers = [name for name in names if name.startswith(COMPILER)]
    found = with_needs(names, here, 1) | with_needs(compilers, here, len(here))
    return [found[name] for name in sorted(found)]


def bill_of(debs: list[Path], version: str, seconds: int, sysroot: Path | None) -> Element:
    ours, files, relations = [], [], []
    debian: dict[str, Element] = {}
    names = {fields_of(deb)["Package"] for deb in debs}
    architecture = fields_of(debs[0])["Architecture"]
    here = installed_here()
    libraries = installed_in(sysroot) if sysroot else here

    def debians(name: str, installed: Installed | None) -> str:
        """Its identifier in the bill."""
        of = installed.architecture if installed else architecture
        element = of_debian(name, installed.version if installed else None, of)
        known = debian.setdefault(element["SPDXID"], element)
        if installed:  # until now one that is needed, in whichever version
            known |= {key: element[key] for key in ("versionInfo", "externalRefs")}
        return str(element["SPDXID"])

    for deb in debs:
        fields = fields_of(deb)
        contents = contents_of(deb)
        included = included_in(contents, fields["Package"])
        licence = " AND ".join([LICENCE, *sorted(set(included.values()))])
        of_deb = files_of(contents, fields["Package"], licence)
        element = of_ours(deb, fields, of_deb, licence)
        ours.append(element)
        files += of_deb
        relations.append(relation("SPDXRef-DOCUMENT", "DESCRIBES", element["SPDXID"]))
        relations += [relation(element["SPDXID"], "CONTAINS", file["SPDXID"]) for file in of_deb]
        needed = sorted({names_in(one)[0] for one in fields.get("Depends", "").split(",") if one.strip()})
        for name in needed:
            # In which version it will be is known where it is installed; of one for all architectures that it is.
            for_all = name in here and here[name].architecture == "all"
            elsewhere = identifier("Debian", name, "all" if for_all else architecture)
            if name not in names:
                debian.setdefault(elsewhere, of_debian(name, None, "all" if for_all else architecture))
            other = identifier("Package", name) if name in names else elsewhere
            relations.append(relation(element["SPDXID"], "DEPENDS_ON", other))
        for name, licence_of_it in included.items():
            if name not in libraries:
                raise SystemExit(
                    f"bill_of_materials.py: {deb.name} is recorded as holding {name}, which is not installed"
                )
            other = debians(name, libraries[name])
            debian[other]["licenseConcluded"] = debian[other]["licenseDeclared"] = licence_of_it
            relations.append(relation(element["SPDXID"], "STATIC_LINK", other))
    tools = built_with(here, sysroot) + (list(libraries.values()) if sysroot else [])
    for installed in tools:
        other = debians(installed.name, installed)
        relations += [relation(other, "BUILD_DEPENDENCY_OF", one["SPDXID"]) for one in ours]
    content = hashlib.sha256(json.dumps([ours, files, debian, relations], sort_keys=True).encode()).hexdigest()
    return {
        "spdxVersion": "SPDX-2.3",
        "dataLicense": "CC0-1.0",
        "SPDXID": "SPDXRef-DOCUMENT",
        "name": f"earshot-{version}-{architecture}",
        "documentNamespace": f"https://spdx.org/spdxdocs/earshot-{version}-{architecture}-{content}",
        "creationInfo": {
            "created": datetime.datetime.fromtimestamp(seconds, datetime.UTC).strftime("%Y-%m-%dT%H:%M:%SZ"),
            "creators": ["Tool: earshot-bill_of_materials"],
        },
        "packages": ours + [debian[name] for name in sorted(debian)],
        "files": files,
        "relationships": relations,
    }


def main(folder: Path, version: str, seconds: int, sysroot: Path | None = None) -> None:
    debs = sorted(folder.glob("*.deb"))
    bill = bill_of(debs, version, seconds, sysroot)
    architecture = fields_of(debs[0])["Architecture"]
    (folder / f"earshot_{version}_{architecture}.spdx.json").write_text(json.dumps(bill, indent=1) + "\n")


if __name__ == "__main__":
    main(Path(sys.argv[1]), sys.argv[2], int(sys.argv[3]), *[Path(word) for word in sys.argv[4:]])
