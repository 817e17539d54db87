#!/usr/bin/env python3
"""sbom_test.py FOLDER [STATIC_BUILD]: the bill of materials of a release in FOLDER is SPDX 2.3, and
true: checksums are those of the files beside it; every library that a program or library in a
package loads is in it, and every archive that the linker says it has used for the static tools in
the folder STATIC_BUILD."""

import hashlib
import json
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
import support  # noqa: E402

FOLDER = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "build/release").resolve()
STATIC = pathlib.Path(sys.argv[2]).resolve() if len(sys.argv) > 2 else None
ID = r"^SPDXRef-[A-Za-z0-9.-]+$"
# What SPDX 2.3 asks for.
OF_DOCUMENT = {"spdxVersion", "dataLicense", "SPDXID", "name", "documentNamespace", "creationInfo",
               "packages", "files", "relationships"}
OF_PACKAGE = {"name", "SPDXID", "downloadLocation", "filesAnalyzed", "versionInfo",
              "licenseConcluded",
              "licenseDeclared", "copyrightText", "supplier", "externalRefs"}
OF_FILE = {"fileName", "SPDXID", "checksums", "licenseConcluded", "copyrightText"}
RELATIONSHIPS = {"DESCRIBES", "DEPENDS_ON", "DYNAMIC_LINK", "STATIC_LINK", "CONTAINS",
                 "GENERATED_FROM",
                 "BUILD_DEPENDENCY_OF"}


def output(*command):
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


def owner(path):
    """The Debian package of a file; with /usr merged, a file may be listed without it."""
    path = str(pathlib.Path(path).resolve())
    for name in (path, path.removeprefix("/usr")):
        done = subprocess.run(["dpkg", "-S", name], capture_output=True, text=True)
        if done.returncode == 0:
            return done.stdout.split(":")[0]
    raise AssertionError(f"{path} is of no package")


class Sbom(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        path, = FOLDER.glob("*.spdx.json")
        cls.bill = json.loads(path.read_text())
        cls.packages = {one["SPDXID"]: one for one in cls.bill["packages"]}
        cls.files = {one["fileName"].removeprefix("./"): one for one in cls.bill["files"]}
        cls.artifacts = [one for one in FOLDER.iterdir()
                         if one.name != "SHA256SUMS" and one.suffix != ".json"]

    def has(self, artifact, how):
        """Names of packages that an artifact has so."""
        me = self.files[artifact.name]["SPDXID"]
        return {self.packages[one["relatedSpdxElement"]]["name"]
                for one in self.bill["relationships"]
                if one["spdxElementId"] == me and one["relationshipType"] == how}

    def test_what_spdx_asks_for_is_there(self):
        self.assertLessEqual(OF_DOCUMENT, set(self.bill))
        self.assertEqual((self.bill["spdxVersion"], self.bill["dataLicense"], self.bill["SPDXID"]),
                         ("SPDX-2.3", "CC0-1.0", "SPDXRef-DOCUMENT"))
        self.assertRegex(self.bill["documentNamespace"], r"^https://[^#]+$")
        self.assertRegex(self.bill["creationInfo"]["created"], r"^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ$")
        for creator in self.bill["creationInfo"]["creators"]:
            self.assertRegex(creator, r"^(Tool|Organization|Person): ")
        for package in self.bill["packages"]:
            self.assertLessEqual(OF_PACKAGE, set(package), package["name"])
            for reference in package["externalRefs"]:
                self.assertEqual((reference["referenceCategory"], reference["referenceType"]),
                                 ("PACKAGE-MANAGER", "purl"))
                self.assertRegex(reference["referenceLocator"],
                                 r"^pkg:(deb/debian/[a-z0-9.%B+-]+@[^:?]+\?arch=\w+|generic/"
                                 r"treeform@[\d.]+)$")
        for file in self.bill["files"]:
            self.assertLessEqual(OF_FILE, set(file))
            self.assertIn("SHA1", [one["algorithm"] for one in file["checksums"]])

    def test_ids_are_unique_and_relationships_lead_somewhere(self):
        ids = ["SPDXRef-DOCUMENT"] + [one["SPDXID"] for one in self.bill["packages"]
                                      + self.bill["files"]]
        self.assertEqual(len(ids), len(set(ids)))
        for one in ids:
            self.assertRegex(one, ID)
        for one in self.bill["relationships"]:
            self.assertIn(one["spdxElementId"], ids)
            self.assertIn(one["relatedSpdxElement"], ids)
            self.assertIn(one["relationshipType"], RELATIONSHIPS)

    def test_every_package_has_a_license(self):
        self.assertEqual([one["name"] for one in self.bill["packages"]
                          if one["licenseDeclared"] in ("", "NOASSERTION")
                          and one["SPDXID"] in self.linked()], [])

    def linked(self):
        return {one["relatedSpdxElement"] for one in self.bill["relationships"]
                if one["relationshipType"] in ("DYNAMIC_LINK", "STATIC_LINK")}

    def test_checksums_are_those_of_the_files(self):
        self.assertEqual(set(self.files), {one.name for one in self.artifacts})
        sums = dict(reversed(line.split("  "))
                    for line in (FOLDER / "SHA256SUMS").read_text().splitlines())
        for one in FOLDER.iterdir():
            if one.name != "SHA256SUMS":
                self.assertEqual(sums[one.name], hashlib.sha256(one.read_bytes()).hexdigest())
        for artifact in self.artifacts:
            checksums = {one["algorithm"]: one["checksumValue"]
                         for one in self.files[artifact.name]["checksums"]}
            for name in ("SHA1", "SHA256"):
                self.assertEqual(checksums[name],
                                 hashlib.new(name.lower(), artifact.read_bytes()).hexdigest())

    def test_what_debian_packages_load_is_listed(self):
        """By ldd, once all of them lie in one folder: what it names beyond our own libraries and
        what is loaded in turn is told apart by objdump."""
        some = 0
        for artifact in FOLDER.glob("*.deb"):
            with tempfile.TemporaryDirectory() as folder:
                output("dpkg-deb", "-x", str(artifact), folder)
                for path in pathlib.Path(folder).rglob("*"):
                    if (path.is_symlink() or not path.is_file()
                            or path.read_bytes()[:4] != b"\x7fELF"):
                        continue
                    found = dict(re.findall(r"^\s*(\S+) => (/\S+)", output("ldd", str(path)), re.M))
                    for name in re.findall(r"^\s*NEEDED\s+(\S+)",
                                           output("objdump", "-p", str(path)), re.M):
                        if name.startswith("libtreeform"):
                            continue
                        some += 1
                        where = found.get(name) or next(pathlib.Path("/lib64").glob(name))
                        self.assertIn(owner(where), self.has(artifact, "DYNAMIC_LINK"),
                                      (artifact.name, name))
        self.assertGreater(some, 20)

    def test_what_a_wheel_brings_is_listed(self):
        for artifact in FOLDER.glob("*.whl"):
            names = re.findall(r"[._]libs/(lib\S+?)(?:-[0-9a-f]{8})?\.so",
                               output("unzip", "-l", str(artifact)))
            brought = self.has(artifact, "CONTAINS")
            self.assertEqual(bool(names), bool(brought))
            for name in set(names):
                path = next(pathlib.Path("/usr/lib/x86_64-linux-gnu").glob(name + ".so*"))
                self.assertIn(owner(path), brought, name)

    def test_what_the_linker_used_is_listed(self):
        if STATIC is None:
            self.skipTest("no folder of the static build is named")
        artifact, = FOLDER.glob("*-linux.tar.gz")
        listed = self.has(artifact, "STATIC_LINK")
        used = set()
        for tool in ("tf-weld", "tf-selfintersect"):
            command = output("ninja", "-C", str(STATIC), "-t", "commands", "-s",
                             f"tools/{tool}/{tool}").splitlines()[-1]
            words = shlex.split(command)
            words = words[words.index("&&", 1) + 1:] if words[:2] == [":", "&&"] else words
            words = words[:words.index("&&")] if "&&" in words else words
            with tempfile.TemporaryDirectory() as folder:
                words[words.index("-o") + 1] = f"{folder}/program"
                said = subprocess.run([*words, "-Wl,--trace"], cwd=STATIC, capture_output=True,
                                      text=True,
                                      check=True).stdout
            used |= set(re.findall(r"(?<![\w.-])(/\S+?\.a)\b", said))
        self.assertGreater(len(used), 5)
        for path in used:
            if pathlib.Path(path).name == "libhwy.a":
                self.assertIn("libhwy-dev", listed)
            elif not path.startswith(str(STATIC)):
                self.assertIn(owner(path), listed, path)

    def test_what_is_headers_alone_is_listed(self):
        names = {one["name"] for one in self.bill["packages"]}
        for name in ("libeigen3-dev", "libcli11-dev", "nlohmann-json3-dev", "python3-pybind11",
                     "libhwy-dev"):
            self.assertIn(name, names)


if __name__ == "__main__":
    support.main("bill of materials: SPDX 2.3, checksums, every library that is loaded or linked")
