"""Which results are kept or repeated: only a change of an input repeats a study."""

import io
import json
import shutil
import signal
import subprocess
import sys
import textwrap
import time
from pathlib import Path

import pytest
from grimp.exceptions import SourceSyntaxError
from rich.console import Console

from validation.harness import fingerprint, registry, runner

# A project of one study: a module that it imports, one that a registry names, one that it does not use.
PROJECT = {
    "pyproject.toml": """
        [project]
        dependencies = ["numpy"]
        optional-dependencies = {suite = ["grimp; python_version > '3'"], dev = ["ruff"]}
        """,
    "toylab/__init__.py": "",
    "toylab/question.py": """
        from pathlib import Path

        from toylab import steps
        from validation.harness.study import Check, Outcome, Study

        def run(context):
            from toylab.methods import build

            here = Path(__file__).parent
            with here.joinpath("runs.log").open("a") as log:
                log.write("run\\n")
            limit = float(here.joinpath("case.toml").read_text())
            return Outcome({}, [Check("error", steps.ERROR * build("mesh").FACTOR, limit, "at_most", "mm", "toy")])

        STUDY = Study("question", "Is it right?", run, needs=())
        """,
    "toylab/steps.py": "ERROR = 1.0\n",
    "toylab/methods.py": """
        import importlib

        METHODS = {"mesh": "toylab.mesh:Mesh"}

        def build(name):
            return importlib.import_module(METHODS[name].partition(":")[0])
        """,
    "toylab/mesh.py": "FACTOR = 1.0\n",
    "toylab/unrelated.py": "NUMBER = 1\n",
    "toylab/case.toml": "2.0",
    "toylab/other.toml": "2.0",
}


def write(root, name, text):
    path = root / name
    path.parent.mkdir(exist_ok=True)
    path.write_text(textwrap.dedent(text))


@pytest.fixture
def lab(tmp_path, monkeypatch, empty_registry):
    """The project on disk, its study alone in the registry; gives its folder."""
    for name, text in PROJECT.items():
        write(tmp_path, name, text)
    registry.STUDIES["question"] = "toylab.question"
    monkeypatch.syspath_prepend(tmp_path)
    yield tmp_path
    forget()


def forget():
    """Import the project anew, as a new process would."""
    for name in [name for name in sys.modules if name.partition(".")[0] == "toylab"]:
        del sys.modules[name]


def run(lab, *names, **options):
    """A run as a new process would see it: exit code and what was printed."""
    forget()
    shutil.rmtree(lab / "toylab" / "__pycache__", ignore_errors=True)  # two edits within a second look alike
    text = io.StringIO()
    chosen = {"quick": False, "data": None, "expected": {}, "results": lab / "results"} | options
    chosen["sources"] = sources(lab)
    return runner.run_all(names or ["question"], console=Console(file=text), **chosen), text.getvalue()


def sources(lab):
    return fingerprint.Sources(lab, ("toylab",))


def runs(lab):
    return len((lab / "toylab" / "runs.log").read_text().splitlines())


def test_a_result_is_kept(lab):
    assert run(lab)[0] == 0
    code, text = run(lab)
    assert (code, runs(lab)) == (0, 1)
    assert "question: 1 met  (kept from " in text
    assert "studies run: 0, kept: 1" in text


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("toylab/question.py", PROJECT["toylab/question.py"].replace("mm", "m")),
        ("toylab/steps.py", "ERROR = 0.5\n"),
        ("toylab/methods.py", PROJECT["toylab/methods.py"] + "LATER = 1\n"),
        ("toylab/mesh.py", "FACTOR = 0.5\n"),
        ("toylab/__init__.py", "NEW = 1\n"),
        ("toylab/case.toml", "3.0"),
    ],
)
def test_a_change_is_noticed_and_named(lab, name, text):
    run(lab)
    write(lab, name, text)
    code, printed = run(lab)
    assert (code, runs(lab)) == (0, 2)
    assert f"changed: {name})" in printed
    run(lab)
    assert runs(lab) == 2


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("toylab/unrelated.py", "NUMBER = 2\n"),
        ("toylab/other.toml", "3.0"),
        ("toylab/steps.py", "# A comment.\n\nERROR  =  1.0\n"),
        ("results/question/notes.txt", "mine"),
    ],
)
def test_what_a_result_does_not_rest_on_may_change(lab, name, text):
    run(lab)
    write(lab, name, text)
    run(lab)
    assert runs(lab) == 1


def test_the_packages_above_a_module_count(lab):
    write(lab, "toylab/inner/__init__.py", "from . import beside\n")
    for name in ("deep", "beside"):
        write(lab, f"toylab/inner/{name}.py", "")
    found = sources(lab).used_by("toylab.inner.deep")
    assert {name.removeprefix("toylab/") for name in found} == {
        "__init__.py", "inner/__init__.py", "inner/deep.py", "inner/beside.py",
    }  # fmt: skip


def test_a_file_that_is_gone_is_a_change(lab):
    run(lab)
    (lab / "toylab" / "case.toml").unlink()
    code, printed = run(lab)
    assert code == 1
    assert "changed: toylab/case.toml" in printed


def test_a_study_fails_that_imports_what_no_statement_and_no_registry_names(lab, capsys):
    hidden = "__import__('importlib').import_module('toylab.' + 'unrelated'); limit = "
    write(lab, "toylab/question.py", PROJECT["toylab/question.py"].replace("limit = ", hidden))
    code, printed = run(lab)
    assert code == 1
    assert "RuntimeError: toylab.unrelated: imported by question under a name made as it runs" in printed


def test_a_source_that_is_no_python_is_named(lab):
    write(lab, "toylab/unrelated.py", "def :")
    with pytest.raises(SourceSyntaxError, match=r"unrelated\.py, line 1"):
        sources(lab)


def test_quick_and_full_are_different_results(lab):
    run(lab, quick=True)
    assert "replaces a quick result" in run(lab)[1]
    assert "replaces a full result" in run(lab, quick=True)[1]
    assert runs(lab) == 3


def test_packages_and_processor_count(lab, monkeypatch):
    run(lab)
    project = textwrap.dedent(PROJECT["pyproject.toml"])
    write(lab, "pyproject.toml", project.replace("ruff", "no-tool"))
    assert "kept from" in run(lab)[1]
    write(lab, "pyproject.toml", project.replace('"grimp', '"no-such-package", "grimp'))
    assert "changed: package no-such-package" in run(lab)[1]
    monkeypatch.setattr(fingerprint, "cpu_name", lambda: "another one")
    assert "changed: processor" in run(lab)[1]
    assert runs(lab) == 3


def test_public_data_count_where_they_are_needed(lab):
    asking = PROJECT["toylab/question.py"].replace("needs=()", "needs=('data',)")
    write(lab, "toylab/question.py", asking.replace('here.joinpath("case', 'context.data.joinpath("case'))
    for folder in ("here", "there"):
        write(lab, f"{folder}/case.toml", "2.0")
        run(lab, data=lab / folder)
    run(lab, data=lab / "there")
    assert runs(lab) == 2
    write(lab, "there/case.toml", "3.0")
    assert "changed: there/case.toml" in run(lab, data=lab / "there")[1]
    assert "question: skipped" in run(lab)[1]
    assert "was skipped" in run(lab, data=lab / "there")[1]
    assert runs(lab) == 4


def test_public_data_are_hidden_from_a_study_that_does_not_ask_for_them(lab):
    write(
        lab,
        "toylab/question.py",
        PROJECT["toylab/question.py"].replace("here =", "assert context.data is None; here ="),
    )
    assert run(lab, data=lab)[0] == 0


def test_the_page_is_told_what_changed(lab):
    asking = PROJECT["toylab/question.py"].replace("needs=()", "needs=('data',)")
    write(lab, "toylab/question.py", asking)
    for quick in (False, True):
        run(lab, data=lab, quick=quick)
        assert runner.changes(["question", "never run"], lab / "results", sources(lab)) == {}
    write(lab, "toylab/case.toml", "3.0")
    assert runner.changes(["question"], lab / "results", sources(lab)) == {"question": "toylab/case.toml"}


def test_the_page_is_told_of_a_study_that_can_no_longer_be_imported(lab):
    run(lab)
    forget()
    write(lab, "toylab/question.py", "import a_module_that_is_not_there\n")
    assert runner.changes(["question"], lab / "results", sources(lab)) == {"question": "toylab/question.py"}


def test_force_repeats(lab):
    run(lab)
    assert "; forced)" in run(lab, force=True)[1]
    assert runs(lab) == 2


@pytest.mark.parametrize("text", ["{", "[]", '{"code": [], "around": []}'])
@pytest.mark.parametrize("damage", ["verdict.json", "inputs.json"])
def test_a_result_that_cannot_be_read_is_repeated(lab, damage, text):
    run(lab)
    (lab / "results" / "question" / damage).write_text(text)
    runner.changes(["question"], lab / "results", sources(lab))  # the page asks, too
    assert run(lab)[0] == 0
    assert runs(lab) == 2


def test_a_result_that_is_a_folder_is_repeated(lab):
    run(lab)
    verdict = lab / "results" / "question" / "verdict.json"
    verdict.unlink()
    verdict.mkdir()
    assert "the result cannot be read" in run(lab)[1]
    assert verdict.is_file()


def test_a_failed_study_is_repeated(lab, capsys):
    write(lab, "toylab/case.toml", "no number")
    assert run(lab)[0] == 1
    code, printed = run(lab)
    assert code == 1
    assert "was failed" in printed
    assert runs(lab) == 2


def test_a_kept_result_is_judged_by_what_is_expected_now(lab):
    write(lab, "toylab/case.toml", "0.5")
    assert run(lab)[0] == 1
    code, printed = run(lab, expected={"question": {"error": "chords"}})
    assert code == 0
    assert "missed (recorded)" in printed
    stored = json.loads((lab / "results" / "question" / "verdict.json").read_text())
    assert stored["checks"][0]["recorded"] == "chords"
    assert run(lab)[0] == 1
    assert runs(lab) == 1
    assert sorted(path.name for path in (lab / "results" / "question").iterdir()) == ["inputs.json", "verdict.json"]


@pytest.mark.slow
def test_a_run_that_was_killed_goes_on_where_it_was(lab):
    write(lab, "toylab/second.py", PROJECT["toylab/question.py"].replace('"question"', '"second"'))
    waiting = (lab / "toylab" / "second.py").read_text().replace("here =", "__import__('time').sleep(3600); here =")
    write(lab, "toylab/second.py", waiting)
    script = """
        import pathlib, sys
        from rich.console import Console
        from validation.harness import fingerprint, registry, runner

        lab = pathlib.Path(sys.argv[1])
        sys.path.insert(0, sys.argv[1])
        registry.STUDIES.clear()
        registry.STUDIES |= {"question": "toylab.question", "second": "toylab.second"}
        runner.run_all(["question", "second"], quick=False, data=None, expected={}, results=lab / "results",
                       sources=fingerprint.Sources(lab, ("toylab",)), console=Console())
        """
    repository = Path(__file__).parents[3]
    with subprocess.Popen([sys.executable, "-c", textwrap.dedent(script), str(lab)], cwd=repository) as process:
        while not (lab / "results" / "question" / "verdict.json").exists():
            assert process.poll() is None
            time.sleep(0.01)
        process.send_signal(signal.SIGKILL)
    write(lab, "toylab/second.py", waiting.replace("sleep(3600)", "sleep(0)"))
    registry.STUDIES["second"] = "toylab.second"
    code, printed = run(lab, "question", "second")
    assert code == 0
    assert "question: 1 met  (kept" in printed
    assert "studies run: 1, kept: 1" in printed
    assert runs(lab) == 2


def test_every_registered_contact_method_and_engine_counts():
    from references import contact, engines

    found = fingerprint.Sources()
    for study, chosen in (("contact_swap", contact.METHODS), ("engines_agree", engines.ENGINES)):
        code = found.used_by(registry.STUDIES[study])
        for where in chosen.values():
            assert where.partition(":")[0].replace(".", "/") + ".py" in code
    overlap = found.used_by("validation.studies.overlap")
    assert "validation/cases/__init__.py" in overlap
    assert not {name for name in overlap if name.startswith("references/engines/")}
    assert {name for name in overlap if name.startswith("fctd/plots/")} == {"fctd/plots/__init__.py"}


def test_the_packages_are_those_of_engine_and_suite():
    names = {name.removeprefix("package ") for name in fingerprint.surroundings(quick=True)}
    assert names >= {"numpy", "numba", "llvmlite", "scipy", "pandas", "mujoco", "grimp", "pyelastica", "python-fcl"}
    assert not names & {"ruff", "mypy", "hypothesis", "pytest", "import-linter"}


@pytest.mark.parametrize("name", ["FCTD_PERTURBED", "NUMBA_CPU_NAME", "NUMBA_CPU_FEATURES", "OPENBLAS_CORETYPE"])
def test_noise_and_other_code_by_the_environment_are_inputs(name, monkeypatch):
    monkeypatch.delenv(name, raising=False)
    plain = fingerprint.surroundings(quick=True)
    monkeypatch.setenv(name, "3")
    assert dict(fingerprint.surroundings(quick=True).items() - plain.items()) == {f"environment {name}": "3"}
