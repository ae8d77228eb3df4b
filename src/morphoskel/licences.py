"""List the licences of all dependencies.

Run as ``python -m morphoskel.licences`` in an environment of ``requirements.lock``, from the repository's folder.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from importlib.metadata import Distribution, distributions
from pathlib import Path

from morphoskel.errors import InputError
from morphoskel.lock import OPEN3D_WHEELS

HEADER = """\
# Licences of the dependencies

Every package of `requirements.lock`, with the licence that its own metadata state. Written by `make licences`; do not
edit. None of them is part of this repository; the page of the interactive viewer holds a part of three.js (MIT, see
`src/morphoskel/reporting/assets/three.LICENSE`). This is a list, not legal advice: wheels such as those of NumPy,
SciPy, torch and Open3D bundle further libraries, whose licences lie beside them where they are installed.

| package | version | licence |
|:--|:--|:--|
"""

NOT_STATED = "not stated"

_PIN = re.compile(r"([A-Za-z0-9._-]+)==([^ ;]+)")
_LONGEST = 110  # longer texts in the field are whole licences


def pinned(lines: Sequence[str]) -> dict[str, str]:
    """Return the versions in ``requirements.lock`` by package."""
    return {found[1]: found[2] for line in lines if (found := _PIN.match(line))}


def licence_of(package: Distribution) -> str:
    """Return what a package's metadata say of its licence, or the first line of its licence file.

    Parameters
    ----------
    package
        Installed.
    """
    metadata = package.metadata
    if "License-Expression" in metadata:
        return metadata["License-Expression"]
    classifiers = [text for text in metadata.get_all("Classifier") or [] if text.startswith("License :: ")]
    names = [text.rsplit(" :: ", 1)[1] for text in classifiers if text != "License :: DFSG approved"]
    field = metadata["License"].strip() if "License" in metadata else ""
    if names or (0 < len(field) <= _LONGEST and field != "UNKNOWN" and "\n" not in field):
        return ", ".join(names) or field
    for file in package.files or []:
        if re.match(r"licen[cs]e|copying", file.name, re.IGNORECASE) and ".dist-info" in str(file):
            text = Path(str(package.locate_file(file))).read_text(encoding="utf-8", errors="replace")
            return next((line.strip("# ") for line in text.splitlines() if line.strip("# ")), NOT_STATED)
    return NOT_STATED


def licence_page(lines: Sequence[str]) -> str:
    """Return the content of ``docs/licences.md``.

    Parameters
    ----------
    lines
        Of ``requirements.lock``.

    Raises
    ------
    InputError
        If a package is not installed in its pinned version.
    """
    installed = {item.metadata["Name"].lower().replace("_", "-"): item for item in distributions()}
    rows = []
    for name, version in pinned(lines).items():
        wheels = list(OPEN3D_WHEELS) if name in OPEN3D_WHEELS else [name]
        package = next((installed[wheel] for wheel in wheels if wheel in installed), None)
        if package is None or package.version.split("+")[0] != version:
            raise InputError(
                f"{name}: expected version {version} of requirements.lock to be installed, found "
                f"{package.version if package else 'none'}; run make, or make lock"
            )
        rows.append(f"| {name} | {version} | {licence_of(package).replace('|', '/')} |\n")
    return HEADER + "".join(rows)


if __name__ == "__main__":
    locked = Path("requirements.lock").read_text(encoding="utf-8").splitlines()
    Path("docs/licences.md").write_text(licence_page(locked), encoding="utf-8")
