"""Print the installed versions as a lock file; run as ``python -m morphoskel.lock`` in an environment made for it."""

from __future__ import annotations

import sys
from importlib.metadata import distributions

HEADER = """\
# Every dependency, pinned. Written by `make lock`; do not edit.
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


if __name__ == "__main__":
    sys.stdout.write(HEADER + "\n".join(lock_lines()) + "\n")
