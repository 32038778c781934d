"""Does requirements.lock hold all that each supported Python needs, as wheels, alone and together with rivals.lock?

Nothing is installed.  ``python .ci/resolve.py`` does nothing while the locks are those that the file ``resolved``
records; otherwise it resolves them for every Python and writes the record, which is committed with the locks.
"""

import hashlib
import json
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

from packaging.markers import Environment, default_environment
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

LOCK = Path(__file__).parents[1] / "requirements.lock"
RIVALS = LOCK.with_name("rivals.lock")
RECORD = Path(__file__).with_name("resolved")
PYTHONS = ("3.11", "3.12", "3.13", "3.14")


def environment(python: str) -> Environment:
    """Markers' environment of this machine with another Python."""
    here = default_environment()
    here["python_version"], here["python_full_version"], here["implementation_version"] = python, *2 * (f"{python}.0",)
    return here


def pins(lock: str) -> list[str]:
    """The lines of a lock without its comments."""
    lines = (line.partition("#")[0].strip() for line in lock.splitlines())
    return [line for line in lines if line]


def wanted(lock: str, python: str) -> list[Requirement]:
    """Requirements of a lock that hold for a Python; pip itself would judge their markers by the Python it runs on."""
    found = [Requirement(line) for line in pins(lock)]
    return [each for each in found if each.marker is None or each.marker.evaluate(environment(python))]


def unmet(packages: list[dict[str, Any]], locked: list[Requirement], python: str) -> list[str]:
    """What packages, as in pip's report, need on a Python and the lock does not hold."""
    by_name = {canonicalize_name(each.name): each for each in locked}
    missing = []
    for package in packages:
        for text in package["metadata"].get("requires_dist", []):
            need = Requirement(text)
            if need.marker is not None and not need.marker.evaluate({**environment(python), "extra": ""}):
                continue
            pin = by_name.get(canonicalize_name(need.name))
            if pin is None or not need.specifier.contains(next(iter(pin.specifier)).version, prereleases=True):
                missing.append(f"{package['metadata']['name']} needs {need}, the lock has {pin or 'none'}")
    return missing


def lacking(packages: list[dict[str, Any]], suite: str, rivals: str, python: str) -> list[str]:
    """What the lock of the suite lacks by itself, and what both locks lack together."""
    alone, both = wanted(suite, python), wanted(f"{suite}\n{rivals}", python)
    names = {canonicalize_name(each.name) for each in alone}
    of_suite = [each for each in packages if canonicalize_name(each["metadata"]["name"]) in names]
    return list(dict.fromkeys([*unmet(of_suite, alone, python), *unmet(packages, both, python)]))


def resolve(suite: str, rivals: str, python: str) -> list[str]:
    """What keeps the locks from being installed on a Python, in words."""
    with tempfile.TemporaryDirectory() as scratch:
        report = Path(scratch, "report.json")
        command = [
            sys.executable, "-m", "pip", "install", "--dry-run", "--quiet", "--disable-pip-version-check", "--no-deps",
            "--ignore-installed", "--only-binary=:all:", "--python-version", python, "--target", scratch,
            "--report", str(report), *(f"{each.name}{each.specifier}" for each in wanted(f"{suite}\n{rivals}", python)),
        ]  # fmt: skip
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode:
            return [line for line in done.stderr.splitlines() if line.startswith("ERROR")] or [done.stderr.strip()]
        return lacking(json.loads(report.read_text())["install"], suite, rivals, python)


def main() -> int:
    """Exit code: 0 when the locks resolve, 1 when they do not."""
    suite, rivals = LOCK.read_text(), RIVALS.read_text()
    names = f"{LOCK.name}, {RIVALS.name}"
    now = hashlib.sha256("\n".join([*PYTHONS, *pins(suite), RIVALS.name, *pins(rivals)]).encode()).hexdigest()
    if RECORD.is_file() and RECORD.read_text().strip() == now:
        print(f"{names}: resolved before for Python {', '.join(PYTHONS)}")
        return 0
    failures = []
    for python in PYTHONS:
        found = resolve(suite, rivals, python)
        print(f"{names}: Python {python}: {'; '.join(found) or 'resolves'}", flush=True)
        failures += found
    if failures:
        return 1
    RECORD.write_text(now + "\n")
    print(f"commit {RECORD.parent.name}/{RECORD.name}: the locks are not resolved again until one changes")
    return 0


if __name__ == "__main__":
    sys.exit(main())
