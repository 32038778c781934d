"""Sweep files: what they may say, and how a wrong one is answered."""

from pathlib import Path

import pytest

from fctd.case.errors import InputError
from fctd.sweep.spec import ParameterSpec, read_sweep, split_number
from validation.parts.small_sweep import PARAMETERS, WORK, sweep_file

LHS = 'method = "latin_hypercube"\nsamples = 12\n'
GRID = '[[parameters]]\nkey = "friction"\nvalues = [0.1, 0.2]\n'


def parameter(text: str) -> str:
    return f'[[parameters]]\nkey = "mud.density"\n{text}\n'


def test_a_sweep_is_read(tmp_path: Path) -> None:
    spec = read_sweep(sweep_file(tmp_path))
    assert spec.case == tmp_path / "well.toml"
    assert [p.key for p in spec.parameters] == ["friction.open", "mud.density"]
    assert (spec.parameters[1].unit, spec.parameters[1].number("low")) == ("sg", 1.0)
    assert spec.work.operations == ("trip_out",)


# What is wrong with a file, and words of the answer.
WRONG = {
    "method": ('method = "guess"\nsamples = 3', PARAMETERS + WORK, ["method", "latin_hypercube"]),
    "no samples": ('method = "sobol"', PARAMETERS + WORK, ["samples", "the number of samples"]),
    "samples of a grid": ('method = "grid"\nsamples = 3', GRID + WORK, ["samples", "grid"]),
    "list of unequal length": (
        'method = "list"', GRID + parameter("values = [1000, 1100, 1200]") + WORK, ["as many values", "2, 3"],
    ),
    "distribution in a grid": ('method = "grid"', PARAMETERS + WORK, ["parameters[0].distribution", "values"]),
    "count in a drawn method": (LHS, parameter("low = 1000\nhigh = 1200\ncount = 3") + WORK, ["parameters[0].count"]),
    "unknown distribution": (LHS, parameter('distribution = "gamma"') + WORK, ["distribution", "'triangular'"]),
    "missing number": (LHS, parameter('distribution = "normal"\nmean = 1200') + WORK, ["parameters[0].sd", "normal"]),
    "number too many": (
        LHS, parameter('distribution = "uniform"\nlow = 1\nhigh = 2\nmean = 1') + WORK, ["parameters[0].mean", "no "],
    ),
    "bounds that fall": (LHS, parameter('distribution = "uniform"\nlow = 3\nhigh = 2') + WORK, ["more than low"]),
    "mode outside": (
        LHS, parameter('distribution = "triangular"\nlow = 1\nmode = 4\nhigh = 3') + WORK, ["at least mode"],
    ),
    "two units": (
        LHS, parameter('distribution = "uniform"\nlow = "1 sg"\nhigh = "9 ppg"') + WORK, ["in sg", "s[0].high"],
    ),
    "no unit beside a unit": (
        LHS, parameter('distribution = "uniform"\nlow = "1 sg"\nhigh = 2') + WORK, ["parameters[0].high", "in sg"],
    ),
    "negative deviation": (LHS, parameter('distribution = "normal"\nmean = 1\nsd = -1') + WORK, ["above 0"]),
    "not a number": (LHS, parameter('distribution = "normal"\nmean = "much"\nsd = 1') + WORK, ["parameters[0].mean"]),
    "infinite": (LHS, parameter('distribution = "normal"\nmean = inf\nsd = 1') + WORK, ["finite"]),
    "values and distribution": (
        LHS, parameter('values = [1, 2]\ndistribution = "normal"') + WORK, ["values or distribution"],
    ),
    "values of two units": (
        'method = "grid"', parameter('values = ["1 sg", "9 ppg"]') + WORK, ["parameters[0].values[1]", "in sg"],
    ),
    "the file as a key": (LHS + 'file = "other.toml"', PARAMETERS + WORK, ["file", "expected"]),
    "mixed values": ('method = "grid"', parameter('values = [1, "a"]') + WORK, ["one kind"]),
    "no values": ('method = "grid"', parameter("values = []") + WORK, ["at least one value"]),
    "key twice": (LHS, PARAMETERS + PARAMETERS + WORK, ["one parameter for each key"]),
    "key also set": (LHS + 'set = {"mud.density" = 1100}', PARAMETERS + WORK, ["set does not have"]),
    "no key": (LHS, '[[parameters]]\nkey = "mud density"\nvalues = [1]\n' + WORK, ["dotted key"]),
    "correlation of another": (
        LHS, PARAMETERS + '[[correlations]]\nkeys = ["friction.open", "friction.cased"]\ncoefficient = 0.5\n' + WORK,
        ["correlations[0].keys", "two parameters"],
    ),
    "correlation with itself": (
        LHS, PARAMETERS + '[[correlations]]\nkeys = ["mud.density", "mud.density"]\ncoefficient = 0.5\n' + WORK,
        ["correlations[0].keys", "two parameters"],
    ),
    "deviation of 0": (LHS, PARAMETERS.replace("sd = 0.05", "sd = 0") + WORK, ["sd", "a standard deviation above 0"]),
    "correlation above 1": (
        LHS, PARAMETERS + '[[correlations]]\nkeys = ["friction.open", "mud.density"]\ncoefficient = 2\n' + WORK,
        ["correlations[0].coefficient", "at most 1"],
    ),
    "correlation twice": (
        LHS, PARAMETERS + 2 * '[[correlations]]\nkeys = ["friction.open", "mud.density"]\ncoefficient = 0.5\n' + WORK,
        ["correlations[1].keys", "one correlation of each pair"],
    ),
    "too many of saltelli": ('method = "saltelli"\nsamples = 8388608', PARAMETERS + WORK, ["samples", "33554432"]),
    "too many of morris": ('method = "morris"\nsamples = 5000000', PARAMETERS + WORK, ["samples", "15000000"]),
    "nothing varies": (LHS, WORK, ["at least one table [[parameters]]"]),
    "no work": (LHS, PARAMETERS, ["work", "a table [work]"]),
    "unknown work": (LHS, PARAMETERS + '[work]\nkind = "guess"\n', ["work.kind", "'chart'"]),
    "unknown operation": (
        LHS, PARAMETERS + '[work]\noperations = ["push"]\ndepths = "1:2:1"\n', ["work.operations[0]", "trip_in"],
    ),
    "no depths": (LHS, PARAMETERS + '[work]\noperations = ["trip_in"]\n', ["work.depths"]),
    "depths of a run": (LHS, PARAMETERS + '[work]\nkind = "simulate"\ndepths = "1:2:1"\n', ["no depths beside"]),
    "key of no table": (LHS + "size = 3", PARAMETERS + WORK, ["size", "key"]),
    "saltelli base": ('method = "saltelli"\nsamples = 12', PARAMETERS + WORK, ["power of 2"]),
    "one parameter of morris": ('method = "morris"\nsamples = 2', parameter("values = [1]") + WORK, ["two parameters"]),
    "limit without bound": (
        LHS, PARAMETERS + WORK + '[[uncertainty.limits]]\ncolumn = "hookload_N"\n', ["above or below"],
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", WRONG)
def test_a_wrong_file_is_answered_by_key_and_expected_value(name: str, tmp_path: Path) -> None:
    head, body, words = WRONG[name]
    path = sweep_file(tmp_path, head, body)
    with pytest.raises(InputError) as caught:
        read_sweep(path)
    text = str(caught.value)
    assert text.startswith(f"{path}: ")
    for word in words:
        assert word in text


def test_values_with_a_unit_are_numbers_and_other_texts_stay() -> None:
    made = ParameterSpec.model_validate({"key": "bit.weight_on_bit", "values": ["20 kN", "60.5 kN"]})
    assert (made.unit, made.choices) == ("kN", (20.0, 60.5))
    for texts in (("arcs", "cylinders"), ("5 in pipe", "4 in pipe"), ("1,5 m", "2 m"), ("0.2", "0.3")):
        made = ParameterSpec.model_validate({"key": "a", "values": texts})
        assert (made.unit, made.choices) == ("", texts)


def test_numbers_have_their_units() -> None:
    assert split_number("1200 kg/m^3", "low") == (1200.0, "kg/m^3")
    assert split_number(3, "low") == (3.0, "")
    assert ParameterSpec.model_validate({"key": "a", "low": 1, "high": 2, "count": 3}).unit == ""
