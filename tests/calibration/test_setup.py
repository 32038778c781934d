"""The setup file: units, defaults, and messages."""

from pathlib import Path

import pytest

from fctd.calibration.setup import Setup, SourceSpec, read_setup
from fctd.case.errors import InputError


def written(tmp_path: Path, text: str) -> Path:
    path = tmp_path / "setup.toml"
    path.write_text(text, encoding="utf-8")
    return path


def test_a_setup_in_the_units_of_the_field(tmp_path: Path) -> None:
    text = """
    [unknowns."friction.open"]
    bounds = [0.1, 0.5]
    prior = {mean = 0.25, sd = 0.05}
    [unknowns."rig.block_weight"]
    start = "250 kN"
    [sources.DDR]
    reading = "peak"
    hookload_noise = "20 kN"
    torque_bias = {sd = "0.4 kN*m"}
    [strings.wiper]
    "string.components[0].length" = "50 m"
    [model_error]
    torque = "1 kN*m"
    """
    setup = read_setup(written(tmp_path, text))
    assert setup.unknowns["friction.open"].bounds == (0.1, 0.5)
    source = setup.source("DDR")
    assert (source.reading, source.hookload_noise, source.torque_noise) == ("peak", 20e3, 500.0)
    assert source.torque_bias is not None
    assert (source.torque_bias.mean, source.torque_bias.sd) == (0.0, 400.0)
    assert setup.source("none") == SourceSpec()
    assert setup.strings["wiper"] == {"string.components[0].length": "50 m"}
    assert (setup.model_error.hookload, setup.model_error.torque) == (0.0, 1e3)
    assert Setup().unknowns == {}


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("[sources.a]\nreading = 'mean'\n", "sources.a.reading"),
        ("[sources.a]\nhookload_noise = '-1 kN'\n", "a force above 0"),
        ("[source.a]\n", "the key sources"),
        ("[unknowns.friction]\nprior = {mean = 0.2}\n", "prior.sd"),
        ("[strings.'']\n", "a name"),
        ("a =", "a setup in TOML"),
    ],
)
def test_a_wrong_setup_is_answered_with_file_and_key(text: str, expected: str, tmp_path: Path) -> None:
    with pytest.raises(InputError) as raised:
        read_setup(written(tmp_path, text))
    assert "setup.toml" in str(raised.value)
    assert expected in str(raised.value)


def test_scatter_resolution_and_torque_of_a_bit(tmp_path: Path) -> None:
    text = """
    [sources.DDR]
    hookload_resolution = "5 klbf"
    torque_resolution = "1 kft*lbf"
    [bit_torque]
    mean = "4 kN*m"
    sd = "2 kN*m"
    [scatter]
    friction = 0.1
    hookload = "0 N"
    """
    setup = read_setup(written(tmp_path, text))
    assert setup.source("DDR").hookload_resolution == pytest.approx(22241.1, rel=1e-5)
    assert setup.source("DDR").torque_resolution == pytest.approx(1355.82, rel=1e-5)
    assert (setup.scatter.friction, setup.scatter.hookload) == (0.1, 0.0)
    assert setup.bit_torque.of("off_bottom") == (0.0, 0.0)
    assert setup.bit_torque.of("on_bottom") == (4e3, 2e3)
    # Half of the rows on bottom: mean 2, variance (16 + 4)/2 − 4 = 6.
    assert setup.bit_torque.of("unknown") == pytest.approx((2e3, 6**0.5 * 1e3))
