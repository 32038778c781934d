"""The paper's claims on the page: verdict, number, bound and study, and what was not judged."""

from tests.reports.pages import missing, study_page, words_of
from validation.claims.ledger import CLAIMS


def test_claims_stand_on_top_with_verdict_number_bound_and_study(render, claims, tmp_path):
    html, problems = render(studies=["jumps"])
    text = words_of(html)
    assert problems == []
    counts = "✓ holds: 1 ◐ holds with limits: 2 ✗ does not hold: 2 – cannot be tested: 1 ○ not yet run: 1"
    answer = "Mostly: of 7 claims of the paper 1 holds, 2 hold within limits, 2 do not hold and 2 are not decided."
    assert f"Is it so? {answer} {counts} ✗ does not hold: " in text
    holds = "5.2 No &lt;gap&gt; is left. ✓ holds 0.5 kN·m (at most 1 kN·m) largest jump: jumps Bound: target."
    assert f"{holds} python -m validation jumps" in text
    assert "never told" not in text
    assert "abs., 4.2 Owners are found. ◐ holds with limits 0.5 kN·m (at most 0 kN·m: not met)" in text
    assert "Limit. In gentle wells. 0.5 kN·m (at most 2 kN·m) largest jump" in text
    # Next to the first number, before the bound.
    first = "0.5 kN·m (at most 0 kN·m: not met) largest jump: jumps"
    assert not missing(
        text,
        f"{first} Second route. 0.75 kN·m (at most 0 kN·m: not met) largest jump: drops Bound: target.",
        f"{first} No second route. One number is printed. Bound: target.",
        "Second route. 0.75 kN·m (at least 4 kN·m: not met) largest jump: drops Bound: target.",
        "Mind the step.",
        "✗ does not hold recorded: holds",
        "○ not yet run ownership has not been run python -m validation ownership",
        "– cannot be tested The points are not public",
        "Eq. 4 r̃ω −r̃ω It turns the other way. tests/test_joints.py a hinge moves along",
    )
    assert html.count('id="claims"') == 1
    assert 'href="studies/jumps.html#check-largest-jump"' in html
    assert 'id="check-largest-jump"' in study_page(tmp_path, "jumps").read_text()
    assert 'href="claims.html#claim-good"' in html
    assert 'id="claim-good"' in html
    assert "1 of 7 holds; 2 of 7 hold within limits; 2 of 7 do not hold;" in text


def test_claims_that_were_not_judged(render, tmp_path):
    assert "○ not yet run: " in words_of(render(ledger=CLAIMS)[0])
    (tmp_path / "claims.toml").write_text("[[claim")
    html, problems = render()
    assert problems[0].startswith("claims: the claims cannot be judged: claims.toml: expected a TOML file")
    assert "Failed: the claims cannot be judged: claims.toml" in words_of(html)


def test_a_result_whose_inputs_changed_says_so(render, claims):
    text = words_of(render(studies=["jumps"], changes={"jumps": "fctd/run.py"})[0])
    assert not missing(
        text,
        "Out of date: fctd/run.py has changed since. python -m validation jumps",
        "largest jump: jumps out of date Bound",
        "1 worse than recorded out of date",
    )
    assert "ut of date" not in words_of(render(studies=["jumps"])[0])
