"""A string in time: ten seconds of rotation, and the energy that is not accounted for."""

import fctd

case = fctd.load_case("examples/my_well.toml", {"operations[0].duration": "10 s"})
result = fctd.simulate(case)
print(result.history[["time_s", "hookload_N", "surface_torque_N_m"]].tail(3).round(1).to_string(index=False))
print(f"{result.status}, energy error {result.run['energy_error']:.1e}")
assert result.run["energy_error"] < 1e-3
