"""Refine a string until the error that is left is below 2 %."""

import fctd

case = fctd.load_case("examples/my_well.toml")
found = fctd.refine(case, tolerance=0.02)
print(f"{found.status}: {found.segments} segments, {100 * found.error:.2f} % left")
assert found.error <= 0.02
