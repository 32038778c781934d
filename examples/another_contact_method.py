"""The same run with the paper's search from the top in place of the engine's: the same hook load.

Run it from the checkout with ``python -m examples.another_contact_method``: ``references`` is not installed.
"""

import fctd
from references import contact

case = fctd.load_case("validation/cases/curved_chain.toml", {"operations[0].duration": "1 s"})
own = fctd.simulate(case)
other = fctd.simulate(case, contact=contact.build("for_loop", case, cylinder_length="1 m"))
hookload = [float(result.history["hookload_N"].iloc[-1]) for result in (own, other)]
print(f"hook load {hookload[0] / 1e3:.2f} kN, with {other.run['contact']} {hookload[1] / 1e3:.2f} kN")
assert abs(hookload[1] / hookload[0] - 1) < 1e-3
