"""Write the installed versions as lock files.

Run as ``python -m morphoskel.lock`` in an environment made for it, from the repository's folder.
"""

from __future__ import annotations

from collections.abc import Sequence
from importlib.metadata import distributions
from pathlib import Path

PIP_HEADER = """\
# Every dependency, pinned. Written by `make lock`; do not edit.
"""

CONDA_HEADER = """\
# For conda users; the versions are those of requirements.lock. Written by `make lock`; do not edit.
#   conda env create -f environment.yml && conda activate morphoskel && pip install --no-deps --editable .
name: morphoskel
channels:
  - conda-forge
  - nodefaults
dependencies:
  - python=3.11
  - pip
  - libusb # this and the next three: shared libraries that Open3D loads
  - libgl
  - libegl
  - xorg-libx11
  - pip:
"""

OPEN3D_WHEELS = {
    "open3d-cpu": "sys_platform == 'linux' and platform_machine == 'x86_64'",
    "open3d": "sys_platform != 'linux' or platform_machine != 'x86_64'",
}
"""Open3D's small wheel exists for one platform only; both wheels share version numbers."""

INSTALLERS = frozenset({"pip", "setuptools", "wheel", "morphoskel"})


def lock_lines() -> list[str]:
    """Return one line a distribution, sorted, without local version labels such as ``+cpu``."""
    installed = {
        item.metadata["Name"].lower().replace("_", "-"): item.version.split("+")[0] for item in distributions()
    }
    lines = []
    for name, version in installed.items():
        if name in OPEN3D_WHEELS:
            lines += [f"{wheel}=={version} ; {marker}" for wheel, marker in OPEN3D_WHEELS.items()]
        elif name not in INSTALLERS:
            lines.append(f"{name}=={version}")
    return sorted(lines)


def pip_lock(lines: Sequence[str]) -> str:
    """Return the content of ``requirements.lock``."""
    return PIP_HEADER + "".join(f"{line}\n" for line in lines)


def conda_lock(lines: Sequence[str]) -> str:
    """Return the content of ``environment.yml``."""
    return CONDA_HEADER + "".join(f"      - {line}\n" for line in lines)


if __name__ == "__main__":
    Path("requirements.lock").write_text(pip_lock(lock_lines()), encoding="utf-8")
    Path("environment.yml").write_text(conda_lock(lock_lines()), encoding="utf-8")
