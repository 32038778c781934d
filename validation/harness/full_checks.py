"""Which checks a full run of each study makes: ``validation/checks.toml``, so that a run can name those it leaves out.

``python -m validation.harness.full_checks`` writes it anew from the stored full results, and keeps the other studies.
"""

import json
import tomllib
from collections.abc import Mapping
from pathlib import Path

from fctd.store.whole_file import whole_file
from validation.harness import store
from validation.harness.registry import STUDIES
from validation.harness.store import Record
from validation.harness.study import RESULTS, ROOT

FILE = ROOT / "validation" / "checks.toml"
HEAD = "# The checks of full runs, written by `python -m validation.harness.full_checks` from stored full results.\n"

Full = Mapping[str, list[str]]


def read(path: Path = FILE) -> Full:
    """Study -> the names of its checks in a full run."""
    return tomllib.loads(path.read_text(encoding="utf-8"))


def left_out(record: Record, full: Full) -> list[str]:
    """The checks of a full run that a finished run does not make: it is quick, or lacks a package."""
    made = {judged.check.name for judged in record.checks}
    return [name for name in full.get(record.study, []) if name not in made] if record.status == "finished" else []


def unknown(record: Record, full: Full) -> list[str]:
    """The checks of a finished run that the file should have and has not."""
    known = full.get(record.study)
    return [] if known is None else [judged.check.name for judged in record.checks if judged.check.name not in known]


def write(results: Path, path: Path = FILE) -> list[str]:
    """Write the file anew; return the studies whose checks come from these results."""
    full, fresh = dict(read(path)), []
    for name in STUDIES:
        try:
            record = store.read(results / name)
        except (OSError, ValueError, TypeError, LookupError):
            continue
        if record.status == "finished" and not record.quick and record.checks:
            full[name] = [judged.check.name for judged in record.checks]
            fresh.append(name)
    lines = [HEAD]
    for name in (name for name in STUDIES if name in full):
        lines += [f"\n{name} = [\n", *(f"  {json.dumps(check, ensure_ascii=False)},\n" for check in full[name]), "]\n"]
    with whole_file(path) as scratch:
        scratch.write_text("".join(lines), encoding="utf-8")
    return fresh


if __name__ == "__main__":
    print(f"{FILE.name}: studies written anew: {', '.join(write(RESULTS)) or 'none'}")
