"""Fixtures of the page: it is rendered from records, with a ledger of claims."""

from dataclasses import replace

import pytest

from tests.reports.pages import BLANK, judged, pages_of
from validation.harness import registry, store


@pytest.fixture
def render(tmp_path):
    from reports import page  # needs packages, without which the tests skip

    (tmp_path / "claims.toml").write_text("claim = []")

    def call(*runs, studies=(), changes=None, ledger=tmp_path / "claims.toml", full=None):
        for run, tables in runs:
            store.write(run, tables, tmp_path / "results")
        problems = page.render(tmp_path / "results", studies, tmp_path / "out", changes, ledger, full=full)
        return "".join(path.read_text(encoding="utf-8") for path in pages_of(tmp_path / "out")), problems

    return call


LEDGER = """
[[claim]]
id = "good"
section = "5.2"
says = "No <gap> is left."
verdict = "holds"
because = "target"
[claim.number]
study = "jumps"
check = "largest jump"
at_most = 1.0
[claim.limited]
limit = "never told"
study = "jumps"
check = "largest jump"
at_most = 2.0
[[claim]]
id = "narrow"
section = "abstract, 4.2"
says = "Owners are found."
verdict = "holds with limits"
because = "target"
[claim.number]
study = "jumps"
check = "largest jump"
at_most = 0.0
[claim.limited]
limit = "In gentle wells."
study = "jumps"
check = "largest jump"
at_most = 2.0
[claim.second_route]
study = "drops"
check = "largest jump"
at_most = 0.0
[[claim]]
id = "narrow-by-one-route"
section = "4.3"
says = "Owners were counted."
verdict = "holds with limits"
because = "target"
one_route = "One number is printed."
[claim.number]
study = "jumps"
check = "largest jump"
at_most = 0.0
[claim.limited]
limit = "In wide wells."
study = "jumps"
check = "largest jump"
at_most = 2.0
[[claim]]
id = "wrong"
section = "6.3"
says = "It takes more."
verdict = "does not hold"
because = "target"
remark = "Mind the step."
[claim.number]
study = "jumps"
check = "largest jump"
at_least = 5.0
[claim.second_route]
study = "drops"
check = "largest jump"
at_least = 4.0
[[claim]]
id = "other"
section = "6.3"
says = "Recorded otherwise."
verdict = "holds"
because = "target"
[claim.number]
study = "jumps"
check = "largest jump"
at_most = 0.0
[[claim]]
id = "absent"
section = "7"
says = "Torque is right."
because = "target"
[claim.number]
study = "ownership"
check = "largest jump"
at_most = 0.0
[[claim]]
id = "closed"
section = "7"
says = "It was measured."
verdict = "cannot be tested"
untestable = "The points are not public"
[[misprint]]
where = "Eq. 4"
printed = "r̃ω"
meant = "−r̃ω"
reason = "It turns the other way."
tests = ["tests/test_joints.py::test_a_hinge_moves_along"]
"""


@pytest.fixture
def claims(tmp_path, monkeypatch):
    """A ledger with a claim for every verdict, and the results that it is judged by."""
    (tmp_path / "claims.toml").write_text(LEDGER)
    for name, value in (("jumps", 0.5), ("drops", 0.75)):
        store.write(replace(BLANK, study=name, checks=(judged(value),)), {}, tmp_path / "results")
        monkeypatch.setitem(registry.STUDIES, name, "no.module")
