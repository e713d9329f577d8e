"""Writes earshot_VERSION_ARCHITECTURE.spdx.json, the bill of materials (SPDX 2.3) of the Debian packages in a folder.

It names every file of every package with its checksums, what the packages need where they are installed, and what they
were built with: the group "build" of toolchains/packages.txt, in this machine's versions. Same packages, same bytes.

usage: bill_of_materials.py FOLDER VERSION SECONDS     SECONDS since 1970 stand in it as the time of its making
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
from typing import Any

WANTED = Path(__file__).resolve().parents[1] / "packages.txt"
LICENCE, COPYRIGHT = "Apache-2.0", "2026 The Earshot authors"
Element = dict[str, Any]


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


def files_of(deb: Path, package: str) -> list[Element]:
    """Every regular file that it installs, in the order of their names."""
    found = []
    with tarfile.open(fileobj=io.BytesIO(output_of("dpkg-deb", "--fsys-tarfile", deb))) as tree:
        for member in sorted(tree.getmembers(), key=lambda member: member.name):
            stream = tree.extractfile(member) if member.isfile() else None
            if stream is not None:
                found.append(
                    {
                        "SPDXID": identifier("File", package, hashlib.sha256(member.name.encode()).hexdigest()),
                        "fileName": member.name,
                        "checksums": checksums(stream.read(), "SHA1", "SHA256"),
                        "licenseConcluded": LICENCE,
                        "licenseInfoInFiles": ["NOASSERTION"],
                        "copyrightText": COPYRIGHT,
                    }
                )
    return found


def verification_code(files: list[Element]) -> str:
    """SPDX 2.3, 7.9: SHA1 of the sorted SHA1 of all files."""
    sums = sorted(file["checksums"][0]["checksumValue"] for file in files)
    return hashlib.sha1("".join(sums).encode(), usedforsecurity=False).hexdigest()


def of_debian(name: str, version: str | None, architecture: str) -> Element:
    """A package of Debian's, which is not ours."""
    element: Element = {
        "SPDXID": identifier("Debian", name),
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


def of_ours(deb: Path, fields: dict[str, str], files: list[Element]) -> Element:
    return {
        "SPDXID": identifier("Package", fields["Package"]),
        "name": fields["Package"],
        "versionInfo": fields["Version"],
        "packageFileName": deb.name,
        "downloadLocation": "NOASSERTION",
        "filesAnalyzed": True,
        "packageVerificationCode": {"packageVerificationCodeValue": verification_code(files)},
        "checksums": checksums(deb.read_bytes(), "SHA256"),
        "licenseConcluded": LICENCE,
        "licenseInfoFromFiles": ["NOASSERTION"],
        "licenseDeclared": LICENCE,
        "copyrightText": COPYRIGHT,
        "supplier": "Organization: Earshot",
    }


def fields_of(deb: Path) -> dict[str, str]:
    lines = output_of("dpkg-deb", "--field", deb, "Package", "Version", "Architecture", "Depends").decode().splitlines()
    return dict(line.split(": ", 1) for line in lines)


def built_with() -> list[tuple[str, str]]:
    lines = [line.split("#")[0].split() for line in WANTED.read_text().splitlines()]
    names = sorted({words[1] for words in lines if len(words) >= 2 and words[0] == "build"})
    said = output_of("dpkg-query", "--show", "--showformat", "${Package} ${Version}\n", *names).decode()
    return sorted((words[0], words[1]) for words in (line.split() for line in said.splitlines()))


def bill_of(debs: list[Path], version: str, seconds: int) -> Element:
    ours, files, relations = [], [], []
    debian: dict[str, Element] = {}
    names = {fields_of(deb)["Package"] for deb in debs}
    architecture = fields_of(debs[0])["Architecture"]
    for deb in debs:
        fields = fields_of(deb)
        of_deb = files_of(deb, fields["Package"])
        element = of_ours(deb, fields, of_deb)
        ours.append(element)
        files += of_deb
        relations.append(relation("SPDXRef-DOCUMENT", "DESCRIBES", element["SPDXID"]))
        relations += [relation(element["SPDXID"], "CONTAINS", file["SPDXID"]) for file in of_deb]
        needed = sorted({re.split(r"[ :(|]", name.strip())[0] for name in fields.get("Depends", "").split(",")} - {""})
        for name in needed:
            if name not in names:
                debian.setdefault(name, of_debian(name, None, architecture))
            other = identifier("Package" if name in names else "Debian", name)
            relations.append(relation(element["SPDXID"], "DEPENDS_ON", other))
    here = output_of("dpkg", "--print-architecture").decode().strip()
    for name, installed in built_with():
        debian[name] = of_debian(name, installed, here)
        relations += [relation(identifier("Debian", name), "BUILD_DEPENDENCY_OF", one["SPDXID"]) for one in ours]
    content = hashlib.sha256(json.dumps([ours, files], sort_keys=True).encode()).hexdigest()
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


def main(folder: Path, version: str, seconds: int) -> None:
    debs = sorted(folder.glob("*.deb"))
    bill = bill_of(debs, version, seconds)
    architecture = fields_of(debs[0])["Architecture"]
    (folder / f"earshot_{version}_{architecture}.spdx.json").write_text(json.dumps(bill, indent=1) + "\n")


if __name__ == "__main__":
    main(Path(sys.argv[1]), sys.argv[2], int(sys.argv[3]))
