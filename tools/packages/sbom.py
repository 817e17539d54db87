#!/usr/bin/env python3
"""sbom.py OUT --version V --commit C [--static BUILD] [--headers BUILD]... ARTIFACT...: writes what
a release is made of, as SPDX 2.3 in JSON.

Files: each ARTIFACT, with its checksums. Packages: treeform, and each package of Debian of which a
library is linked or a header compiled into an ARTIFACT: what the programs and libraries inside .deb
packages and wheels load; what a static build in the folder BUILD (--static) has linked in; what the
builds in the other folders have read headers of. A relationship says which artifact has what, and
how. Needs Debian's own tools and Ninja alone. The time is SOURCE_DATE_EPOCH, so that the same
release gives the same bytes."""

import argparse
import datetime
import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import zipfile

# By Debian's source packages. Others have the license that their Debian copyright file names.
LICENSES = {
    "assimp": "BSD-3-Clause",
    "cli11": "BSD-3-Clause",
    "draco": "Apache-2.0",
    "eigen3": "MPL-2.0",
    "gcc-12": "GPL-3.0-or-later WITH GCC-exception-3.1",
    "glibc": "LGPL-2.1-or-later",
    "highway": "Apache-2.0",
    "linux": "GPL-2.0-only WITH Linux-syscall-note",
    "minizip": "Zlib",
    "nlohmann-json3": "MIT",
    "numpy": "BSD-3-Clause",
    "onetbb": "Apache-2.0",
    "openmpi": "BSD-3-Clause",
    "openssl": "Apache-2.0",
    "pugixml": "MIT",
    "pybind11": "BSD-3-Clause",
    "python3.11": "PSF-2.0",
    "zlib": "Zlib",
}
SPDX_OF_DEBIAN = {"Apache-2.0": "Apache-2.0", "BSD-3-clause": "BSD-3-Clause", "BSL-1.0": "BSL-1.0",
                  "Expat": "MIT", "MIT": "MIT", "Zlib": "Zlib", "zlib": "Zlib",
                  "GPL-2+": "GPL-2.0-or-later",
                  "GPL-3+": "GPL-3.0-or-later", "LGPL-2.1+": "LGPL-2.1-or-later",
                  "LGPL-3+": "LGPL-3.0-or-later", "MPL-2.0": "MPL-2.0"}


def run(*command, **named):
    return subprocess.run(command, capture_output=True, text=True, check=True, **named).stdout


def packages_of(paths):
    """The Debian package that each path belongs to; paths of none are left out."""
    found = {}
    wanted = {}
    for path in paths:
        real = os.path.realpath(path)
        # A library may be owned under the name of before /usr was merged with the rest.
        for name in (path, real, *(one[4:] for one in (path, real) if one.startswith("/usr/"))):
            wanted[name] = path
    names = sorted(wanted)
    for start in range(0, len(names), 500):
        done = subprocess.run(["dpkg-query", "-S", *names[start:start + 500]], capture_output=True,
                              text=True)
        for line in done.stdout.splitlines():
            owners, _, name = line.partition(": ")
            if name in wanted and not owners.startswith("diversion"):
                found[wanted[name]] = owners.split(", ")[0].split(":")[0]
    return found


def path_of(soname):
    """Where the loader finds a library."""
    for line in run("/sbin/ldconfig", "-p").splitlines():
        match = re.match(r"\s*(\S+) \(libc6,x86-64[^)]*\) => (\S+)", line)
        if match and match[1] == soname:
            return match[2]
    return None


def dynamic(path):
    """NEEDED and SONAME of a file, or nothing if it is no ELF file."""
    with open(path, "rb") as file:
        if file.read(4) != b"\x7fELF":
            return [], None
    text = run("readelf", "-dW", str(path))
    return (re.findall(r"\(NEEDED\).*\[(.*)\]", text),
            next(iter(re.findall(r"\(SONAME\).*\[(.*)\]", text)), None))


def unpacked(artifact, folder):
    if artifact.suffix == ".deb":
        run("dpkg-deb", "-x", str(artifact), folder)
    else:
        zipfile.ZipFile(artifact).extractall(folder)
    return [path for path in pathlib.Path(folder).rglob("*") if path.is_file()
            and not path.is_symlink()]


def plain(name):
    """The name of a bundled library, whose copy may have a hash in it: libtbb-1a2b3c4d.so.12."""
    return re.sub(r"-[0-9a-f]{8}(?=\.so)", "", name)


def loaded_by(artifact):
    """Two sets of sonames: what is loaded from the system, and what the artifact brings."""
    with tempfile.TemporaryDirectory() as folder:
        needed, brought = set(), set()
        for path in unpacked(artifact, folder):
            names, soname = dynamic(path)
            needed |= {plain(name) for name in names}
            if artifact.suffix == ".whl" and re.search(r"[._]libs/[^/]+[.]so", str(path)):
                brought.add(plain(path.name))
            elif soname:
                needed.discard(soname)
        return needed - brought, brought


def commands_of(build, target):
    return run("ninja", "-C", str(build), "-t", "commands", "-s", target).splitlines()[-1]


def linked_into(build):
    """Archives that the tools of a static build are linked with: ours are left out, and what a
    compiler names without being asked is put in. Highway's is made of the source of its package."""
    archives, highway = set(), False
    programs = [line.split(":")[0]
                for line in run("ninja", "-C", str(build), "-t", "targets", "all").splitlines()
                if "CXX_EXECUTABLE_LINKER" in line]
    for program in programs:
        for name in re.findall(r"\S+\.a\b", commands_of(build, program)):
            highway |= os.path.basename(name) == "libhwy.a"
            if name.startswith("/usr/"):
                archives.add(name)
    for name in ("libstdc++.a", "libgcc.a", "libgcc_eh.a", "libc.a", "libm.a"):
        archives.add(os.path.normpath(run("g++", f"-print-file-name={name}").strip()))
    return archives, highway


def headers_of(build, wanted=lambda output: True):
    """Headers of the system that the objects of a build have read."""
    headers, take = set(), False
    for line in run("ninja", "-C", str(build), "-t", "deps").splitlines():
        if not line.startswith(" "):
            take = "(VALID)" in line and wanted(line.split(":")[0])
        elif take and line.strip().startswith("/usr/"):
            headers.add(os.path.normpath(line.strip()))
    return headers


def license_of(source, package):
    if source in LICENSES:
        return LICENSES[source]
    try:
        text = pathlib.Path("/usr/share/doc", package, "copyright").read_text(errors="replace")
    except OSError:
        return "NOASSERTION"
    match = re.search(r"^Files: \*\n(?:.*\n)*?License: (\S+)", text, re.M)
    return SPDX_OF_DEBIAN.get(match[1], "NOASSERTION") if match else "NOASSERTION"


class Bill:
    def __init__(self, version, commit):
        self.version = version
        self.packages = {}
        self.files = []
        self.relationships = set()
        self.add_package("treeform", {
            "name": "treeform", "versionInfo": version, "licenseDeclared": "Apache-2.0",
            "supplier": "Organization: treeform developers",
            "sourceInfo": f"commit {commit}", "primaryPackagePurpose": "LIBRARY",
            "externalRefs": [{"referenceCategory": "PACKAGE-MANAGER", "referenceType": "purl",
                              "referenceLocator": f"pkg:generic/treeform@{version}"}]})
        self.relate("DOCUMENT", "DESCRIBES", "treeform")

    def add_package(self, key, fields):
        self.packages[key] = {
            "SPDXID": f"SPDXRef-{key}", "downloadLocation": "NOASSERTION", "filesAnalyzed": False,
            "licenseConcluded": "NOASSERTION", "copyrightText": "NOASSERTION", **fields}

    def relate(self, one, how, other):
        self.relationships.add((one, how, other))

    def add_debian(self, name):
        """A package of Debian that is installed here; returns its key."""
        key = "debian-" + re.sub(r"[^A-Za-z0-9.-]", lambda match: f"-{ord(match[0])}-", name)
        if key not in self.packages:
            version, arch, source, source_version = run(
                "dpkg-query", "-W",
                "-f=${Version}\\n${Architecture}\\n${source:Package}\\n${source:Version}\\n",
                name).splitlines()[:4]
            encoded = version.replace("+", "%2B").replace(":", "%3A")
            self.add_package(key, {
                "name": name, "versionInfo": version, "licenseDeclared": license_of(source, name),
                "supplier": "Organization: Debian",
                "sourceInfo": f"built from the Debian source package {source} {source_version}",
                "externalRefs": [{
                    "referenceCategory": "PACKAGE-MANAGER", "referenceType": "purl",
                    "referenceLocator": f"pkg:deb/debian/{name.replace('+', '%2B')}"
                                        f"@{encoded}?arch={arch}"}]})
            self.relate("treeform", "DEPENDS_ON", key)
        return key

    def add_file(self, path):
        key = "file-" + re.sub(r"[^A-Za-z0-9.-]", "-", path.name)
        content = path.read_bytes()
        kind = "ARCHIVE" if path.suffix in (".deb", ".gz", ".whl") else "OTHER"
        self.files.append({
            "SPDXID": f"SPDXRef-{key}", "fileName": f"./{path.name}", "fileTypes": [kind],
            "checksums": [{"algorithm": name.upper(),
                           "checksumValue": hashlib.new(name, content).hexdigest()}
                          for name in ("sha1", "sha256")],
            "licenseConcluded": "NOASSERTION", "copyrightText": "NOASSERTION"})
        self.relate(key, "GENERATED_FROM", "treeform")
        return key

    def text(self):
        seconds = int(os.environ.get("SOURCE_DATE_EPOCH") or 0)
        created = datetime.datetime.fromtimestamp(seconds, datetime.timezone.utc)
        relationships = [{"spdxElementId": f"SPDXRef-{one}", "relationshipType": how,
                          "relatedSpdxElement": f"SPDXRef-{other}"}
                         for one, how, other in sorted(self.relationships)]
        content = {"packages": [self.packages[key] for key in sorted(self.packages)],
                   "files": sorted(self.files, key=lambda file: file["fileName"]),
                   "relationships": relationships}
        digest = hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()
        return json.dumps({
            "spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT",
            "name": f"treeform-{self.version}",
            "documentNamespace": f"https://spdx.org/spdxdocs/treeform-{self.version}-{digest[:32]}",
            "creationInfo": {"created": created.strftime("%Y-%m-%dT%H:%M:%SZ"),
                             "creators": ["Organization: treeform developers",
                                          "Tool: treeform-sbom"]},
            **content}, indent=2) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--version", required=True)
    parser.add_argument("--commit", required=True)
    parser.add_argument("--static", type=pathlib.Path)
    parser.add_argument("--headers", type=pathlib.Path, action="append", default=[])
    parser.add_argument("artifacts", type=pathlib.Path, nargs="+")
    options = parser.parse_args()

    bill = Bill(options.version, options.commit)
    unknown = []
    for artifact in sorted(options.artifacts):
        key = bill.add_file(artifact)
        if artifact.suffix in (".deb", ".whl"):
            for names, how in zip(loaded_by(artifact), ("DYNAMIC_LINK", "CONTAINS")):
                for name in sorted(names):
                    if name.startswith("libtreeform_"):
                        continue
                    path = path_of(name)
                    owners = packages_of([path]) if path else {}
                    if owners:
                        bill.relate(key, how, bill.add_debian(owners[path]))
                    else:
                        unknown.append(f"{artifact.name}: {name} is of no package")
        elif options.static and artifact.name.endswith("-linux.tar.gz"):
            archives, highway = linked_into(options.static)
            owners = packages_of(archives)
            unknown += [f"{artifact.name}: {name} is of no package"
                        for name in archives - set(owners)]
            for owner in set(owners.values()) | ({"libhwy-dev"} if highway else set()):
                bill.relate(key, "STATIC_LINK", bill.add_debian(owner))
    # What is made of headers alone is in what was compiled.
    for build in [*options.headers, *([options.static] if options.static else [])]:
        for owner in set(packages_of(headers_of(build)).values()):
            bill.relate(bill.add_debian(owner), "BUILD_DEPENDENCY_OF", "treeform")
    options.out.write_text(bill.text())
    for line in unknown:
        print(line, file=sys.stderr)
    return bool(unknown)


if __name__ == "__main__":
    sys.exit(main())
