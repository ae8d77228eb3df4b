"""Check that the shared libraries which Open3D loads are there; run as ``python -m morphoskel.system_libraries``."""

from __future__ import annotations

import ctypes
import os
import shutil
import subprocess
import sys

PACKAGES = {
    "libusb-1.0.so.0": "libusb-1.0-0",
    "libGL.so.1": "libgl1",
    "libEGL.so.1": "libegl1",
    "libX11.so.6": "libx11-6",
    "libudev.so.1": "libudev1",
    "libgomp.so.1": "libgomp1",
}
"""Debian package of each shared library."""


def missing_libraries() -> list[str]:
    """Return the shared libraries that the loader does not find."""
    missing = []
    for library in PACKAGES:
        try:
            ctypes.CDLL(library)
        except OSError:
            missing.append(library)
    return missing


def install_command(libraries: list[str]) -> list[str]:
    """Return the command that installs the packages of these libraries on Debian and its kin."""
    packages = [PACKAGES[library] for library in libraries]
    return ["apt-get", "install", "--yes", "--no-install-recommends", *packages]


def ensure_libraries() -> str:
    """Install what is missing, when root and with apt at hand.

    Returns
    -------
    str
        Empty if everything is there now; else what is missing and the one command that installs it.
    """
    if not sys.platform.startswith("linux"):
        return ""
    missing = missing_libraries()
    if not missing:
        return ""
    command = install_command(missing)
    if os.geteuid() == 0 and shutil.which("apt-get"):
        subprocess.run(["apt-get", "update", "--quiet", "--quiet"], check=True)
        subprocess.run(command, check=True, env={**os.environ, "DEBIAN_FRONTEND": "noninteractive"})
        missing = missing_libraries()
    if not missing:
        return ""
    return (
        f"Open3D needs shared libraries that are missing: {', '.join(missing)}. Install them, then try again:\n"
        f"  sudo {' '.join(command)}"
    )


if __name__ == "__main__":
    sys.exit(ensure_libraries() or None)
