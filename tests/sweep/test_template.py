"""Cases of samples: keys with their units, friction by kind, erred surveys, and seeds of tortuosity."""

import re
from pathlib import Path

import numpy as np
import pytest

from fctd.case.errors import InputError
from fctd.case.load import load_case
from fctd.sweep.design import sample_of, samples_of
from fctd.sweep.spec import read_sweep
from fctd.sweep.template import Template, template_of
from validation.parts.small_sweep import PARAMETERS, WORK, sweep_file

HEAD = 'method = "random"\nsamples = 5\n'


def template(folder: Path, head: str = HEAD, body: str = PARAMETERS + WORK, case: str = "") -> Template:
    return template_of_file(sweep_file(folder, head, body, case))


def template_of_file(path: Path) -> Template:
    spec = read_sweep(path)
    return template_of(spec, sample_of(samples_of(spec), 0))


def test_a_sample_is_the_case_with_its_values(tmp_path: Path) -> None:
    case = template(tmp_path).case(0, {"friction.open": 0.41, "mud.density": 1.25})
    wanted = load_case(tmp_path / "well.toml", {"friction": {"open": 0.41}, "mud.density": "1.25 sg"})
    assert case.model_dump(exclude={"file"}) == wanted.model_dump(exclude={"file"})


def test_the_factor_around_the_hole_is_set_after_the_one_that_sets_both(tmp_path: Path) -> None:
    for order in (("rotational_friction.open", "friction"), ("friction", "rotational_friction.open")):
        values = {"friction": 0.4, "rotational_friction.open": 0.1}
        case = template(tmp_path).case(0, {key: values[key] for key in order})
        factors = [(interval.friction, interval.friction_around) for interval in case.wellbore.intervals]
        assert factors == [(0.4, 0.4), (0.4, 0.1)]


def test_a_fixed_factor_around_the_hole_stays_beside_one_that_varies(tmp_path: Path) -> None:
    made = template(tmp_path, HEAD + 'set = {"rotational_friction.open" = 0.1, "friction" = 0.2}\n')
    first = [(interval.friction, interval.friction_around) for interval in made.base.wellbore.intervals]
    varied = [(one.friction, one.friction_around) for one in made.case(0, {"friction": 0.4}).wellbore.intervals]
    assert (first, varied) == ([(0.2, 0.2), (0.2, 0.1)], [(0.4, 0.4), (0.4, 0.1)])


def test_fixed_keys_are_those_of_all_samples(tmp_path: Path) -> None:
    made = template(tmp_path, HEAD + 'set = {"bit.weight_on_bit" = "50 kN", "friction.cased" = 0.11}\n')
    case = made.case(3, {"friction.open": 0.41, "mud.density": 1.25})
    assert case.bit.weight_on_bit == 50e3
    assert [interval.friction for interval in case.wellbore.intervals] == [0.11, 0.41]
    assert made.base.bit.weight_on_bit == 50e3


def test_a_survey_file_is_read_once_and_found_from_anywhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = tmp_path / "project"
    folder.mkdir()
    path = sweep_file(folder, HEAD)
    (folder / "survey.csv").write_text("md_m,inc_deg,azi_deg\n0,0,0\n200,0,0\n500,45,30\n900,45,30\n", encoding="utf-8")
    text = (folder / "well.toml").read_text(encoding="utf-8")
    stations = "stations = [[0, 0, 0], [200, 0, 0], [500, 45, 30], [900, 45, 30]]"
    assert stations in text
    (folder / "well.toml").write_text(text.replace(stations, 'survey = "survey.csv"'), encoding="utf-8")
    made = template_of_file(path)
    (folder / "survey.csv").unlink()
    monkeypatch.chdir(tmp_path)
    assert made.case(0, {"friction.open": 0.4}).wellbore.trajectory is made.base.wellbore.trajectory


def test_a_parameter_may_have_a_key_that_the_case_needs(tmp_path: Path) -> None:
    """Waves have an amplitude and a wavelength; here the one is drawn, the other fixed."""
    drawn = '[[parameters]]\nkey = "wellbore.tortuosity.amplitude"\nvalues = ["1 cm", "2 cm"]\n'
    made = template(tmp_path, HEAD + 'set = {"wellbore.tortuosity.wavelength" = "100 m"}\n', drawn + WORK)
    waves = made.case(0, {"wellbore.tortuosity.amplitude": "2 cm"}).wellbore.tortuosity
    assert waves is not None
    assert (waves.amplitude, waves.wavelength) == (0.02, 100)
    wrong = 'set = {"wellbore.tortuosity.wavelength" = "100 m", "mud.density" = "1 m"}\n'
    with pytest.raises(InputError, match=r"^set.mud.density = .1 m.: expected a density"):
        template(tmp_path, HEAD + wrong, drawn + WORK)


@pytest.mark.parametrize(("key", "other"), [
    ("friction", "friction.open"), ("friction.open", "wellbore.intervals[1].friction"),
    ("wellbore.intervals[0].friction", "friction"), ("rotational_friction", "rotational_friction.open"),
    ("rotational_friction", "wellbore.intervals[1].rotational_friction"),
])  # fmt: skip
def test_parameters_that_set_the_same_number_are_refused(tmp_path: Path, key: str, other: str) -> None:
    """The later one would hide the earlier one, whose influence would then be none."""
    body = "".join(f'[[parameters]]\nkey = "{name}"\nvalues = [0.1, 0.2]\n' for name in (key, other))
    with pytest.raises(InputError, match=rf"parameters\[1\].key = .*{re.escape(key)}, which has some of them"):
        template(tmp_path, HEAD, body + WORK)
    apart = body.replace(key, "friction.cased").replace(other, "friction.open")
    assert template(tmp_path, HEAD, apart + WORK).base.name == "small"


def test_erred_surveys_depend_on_seed_and_sample_alone(tmp_path: Path) -> None:
    body = '[survey]\ntool = "mwd"\n' + WORK
    made = template(tmp_path, HEAD, body)
    one, again, other = (made.case(k, {}).wellbore.trajectory for k in (4, 4, 5))
    assert (one == again).all()
    assert (one != other).any()
    assert one[:, 0].tolist() == made.base.wellbore.trajectory[:, 0].tolist()
    assert np.degrees(np.abs(one - made.base.wellbore.trajectory)[:, 1]).max() < 5 * 0.3


@pytest.mark.parametrize(
    ("head", "groups"),
    [
        ('method = "saltelli"\nsamples = 2\n', [[0, 1, 2], [3], [4, 5, 6], [7]]),
        ('method = "morris"\nsamples = 2\n', [[0, 1, 2], [3, 4, 5]]),
        ('method = "random"\nsamples = 3\n', [[0], [1], [2]]),
    ],
)
def test_samples_that_indices_compare_have_the_same_survey(tmp_path: Path, head: str, groups: list[list[int]]) -> None:
    """The spread of the survey would else be counted as influence of each parameter."""
    made = template(tmp_path, head, PARAMETERS + '[survey]\ntool = "mwd"\n' + WORK)
    surveys = {k: made.case(k, {}).wellbore.trajectory for group in groups for k in group}
    for group in groups:
        for k, survey in surveys.items():
            assert (survey == surveys[group[0]]).all() == (k in group)


def test_each_sample_has_its_own_waves(tmp_path: Path) -> None:
    waves = 'set = {"wellbore.tortuosity.amplitude" = "5 mm", "wellbore.tortuosity.wavelength" = "40 m"}\n'
    made = template(tmp_path, HEAD + "tortuosity_seeds = true\n" + waves, WORK)
    seeds = [made.case(k, {}).wellbore.tortuosity for k in (0, 0, 1)]
    assert seeds[0] == seeds[1]
    assert seeds[0] != seeds[2]


@pytest.mark.parametrize(
    ("key", "value", "words"),
    [
        ("mud.densty", 1.2, ["mud.densty", "density"]),
        ("mud.density", 9.0, ["mud.density", "below the string's"]),
        ("friction.closed", 0.2, ["friction", "the kind cased"]),
        ("string.components[7].length", 2, ["a key that exists"]),
    ],
)
def test_values_that_no_case_can_have_name_the_key(key: str, value: float, words: list[str], tmp_path: Path) -> None:
    made = template(tmp_path)
    with pytest.raises(InputError) as caught:
        made.case(0, {key: value})
    for word in words:
        assert word in str(caught.value)


def test_a_fault_of_the_case_file_names_that_file(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"well\.toml: bit\.weight_on_bitt = 1: expected the key weight_on_bit"):
        template(tmp_path, case="[bit]\nweight_on_bitt = 1\n")


def test_a_case_file_that_is_not_there_is_named(tmp_path: Path) -> None:
    path = sweep_file(tmp_path)
    (tmp_path / "well.toml").unlink()
    with pytest.raises(InputError, match=r"^case = .*well\.toml.: expected a case file that can be read"):
        template_of_file(path)
