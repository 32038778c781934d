"""Drawn fluids, rigs, bits, laws and operations: the tables of a case beside hole and string."""

from typing import Any

from tests.equivalence.dice import Dice
from tests.equivalence.holes import INCH, Raw

STICKING = ("karnopp", "stribeck")


def flow_of(dice: Dice) -> Raw:
    """What a mud's flow follows."""
    bingham = {"plastic_viscosity": dice.number(0.01, 0.04), "yield_point": dice.number(2, 9)}
    power = {"consistency": dice.number(0.2, 0.9), "index": dice.number(0.5, 0.9)}
    herschel = power | {"yield_stress": dice.number(0.5, 4)}
    return dice.pick(
        [
            {"viscosity": dice.number(0.005, 0.03)},
            {"rheology": bingham},
            {"rheology": power},
            {"rheology": herschel},
            {"fann": {"600": 62.0, "300": 38.0, "6": 7.0, "3": 5.0}},
        ]
    )


def mud(dice: Dice, total: float) -> Raw:
    """The table of the mud; fluids by depth stand beside a float, which holds what differs."""
    table: Raw = {"density": dice.number(1000, 1500)}
    if dice.chance(0.4):
        table |= flow_of(dice)
        if dice.chance(0.4):
            table["eccentricity"] = dice.pick(["string", dice.number(0.1, 0.9, 2)])
    elif dice.chance(0.2):
        table |= {"axial_damping": dice.number(1, 8), "rotational_damping": dice.number(0.05, 0.3)}
        table["lateral_damping"] = dice.number(5, 50)
    if dice.chance(0.25):
        table["float"] = True
        if dice.chance(0.8):
            table["inside"] = columns(dice, total)
            if dice.chance(0.4):
                table["inside"][0]["plug"] = True
                if dice.chance(0.5):
                    table["inside"][1]["pressure"] = dice.number(1e5, 4e6)
        if dice.chance(0.6):
            table["outside"] = columns(dice, total)
            if dice.chance(0.3) and "fann" not in table:
                table["outside"][-1] |= flow_of(dice)
        for side in ("inside", "outside"):
            if dice.chance(0.3):
                table[f"{side}_pressure"] = dice.number(1e5, 3e6)
            if side in table and dice.chance(0.2):
                table[side][0] |= flow_of(dice)
    elif dice.chance(0.06):
        table["packer_bore"] = dice.number(0.06, 0.12)
        table["inside_pressure"] = dice.number(1e5, 3e6)
    return table


def columns(dice: Dice, total: float) -> list[Raw]:
    """Two fluids, one above the other."""
    met = round(dice.number(0.1, 0.45) * total, 1)
    return [{"to_md": met, "density": dice.number(900, 1500)}, {"density": dice.number(1000, 1500)}]


def rig(dice: Dice) -> Raw:
    """The table of the rig; what acts in time alone too."""
    table: Raw = {}
    keys: dict[str, Any] = {
        "block_weight": dice.number(5e4, 3e5), "guide_friction": dice.number(1e3, 9e3),
        "sheave_efficiency": dice.number(0.9, 1.0), "torque_offset": dice.number(-500, 900),
        "torque_per_rpm": dice.number(1, 9), "hoist_capacity": dice.number(3e5, 4e6),
        "largest_torque": dice.number(5e3, 6e4), "slip_length": dice.number(0.3, 0.5),
        "feed": dice.pick(["auto", "long_segment", "stands"]), "stand_length": dice.number(18, 28),
        "connection_time": dice.number(30, 200), "derrick_height": dice.number(35, 45),
        "drive": dice.pick(["speed_control", "impedance"]), "autodriller": True,
        "surface_length": dice.number(20, 90), "surface_bore": dice.number(0.07, 0.11),
        "control": {"inertia": dice.number(1500, 3000), "proportional": dice.number(200, 600),
                    "integral": dice.number(100, 400), "compensation": dice.number(0, 1),
                    "torque_limit": dice.number(2e4, 6e4)},
    }  # fmt: skip
    for key, value in keys.items():
        if dice.chance(0.25):
            table[key] = value
    return table


def bit(dice: Dice, swivel: bool) -> Raw:
    """The table of the bit."""
    table: Raw = {}
    if dice.chance(0.5):
        table["weight_on_bit"] = dice.number(2e3, 3e4)
        if not swivel:
            table["torque"] = dice.number(200, 3000)
    if dice.chance(0.2):
        table["overpull"] = dice.number(1e4, 9e4)
    if dice.chance(0.5):
        table |= dice.pick([{"nozzles": [12 / 32 * INCH] * dice.whole(2, 4)}, {"flow_area": dice.number(2e-4, 6e-4)}])
        if dice.chance(0.4):
            table["discharge"] = dice.number(0.9, 1.0)
    if dice.chance(0.1) and not swivel:
        table["rock"] = {
            "law": dice.pick(["drag_bit", "given"]), "stiffness": 2.5e7, "radius": 0.1, "specific_energy": 9e7,
            "force_ratio": 0.7, "friction": 0.5, "bit_factor": 1.1, "wear_flat": 0.004, "contact_strength": 9e7,
            "weakening": 0.2, "weakening_rpm": 25.0,
        }  # fmt: skip
    if dice.chance(0.1):
        table["motor"] = {"flow": dice.number(0.02, 0.04), "revolutions_per_liter": 0.07}
    return table


def contact(dice: Dice, bows: bool) -> Raw:
    """Laws of friction and wall."""
    table: Raw = {}
    if dice.chance(0.4):
        table["friction_law"] = dice.pick(["coulomb", "paper", *STICKING])
    if dice.chance(0.15) and not bows:
        table |= {"law": "power", "exponent": dice.number(1.2, 1.8), "reference_penetration": 0.0012}
        table["largest_penetration"] = 0.004
    if dice.chance(0.1):
        table["damping"] = dice.number(5e4, 2e5)
    if dice.chance(0.1):
        table["helical_force"] = "analytic"
    return table


def sticking(dice: Dice, case: Raw) -> None:
    """Static factors and mud cake, which act in time alone, beside the laws that have them."""
    law, linear = case["contact"].get("friction_law"), "law" not in case["contact"]
    if law not in STICKING:
        return
    for row in case["wellbore"]["intervals"]:
        if row["friction"] and dice.chance(0.7):
            row["static_friction"] = round(1.2 * row["friction"], 4)
            if law == "stribeck":
                row["decay_speed"] = dice.number(0.1, 0.6)
        if linear and dice.chance(0.3):
            row["overbalance"] = dice.number(1e6, 9e6)
            case["mud"]["cake"] = {"friction": 0.2, "thickness": 0.003, "time": 2e4, "rested": 600.0}


def solver(dice: Dice) -> Raw:
    """How a case is computed; steps and dampings act in time alone."""
    keys: dict[str, Any] = {
        "step": dice.pick(["auto", "largest", 0.001]), "joint_damping": 2e-5, "shape_damping": 2e-3,
        "loss_factor": 0.01,        "resolve_work": 9e6, "buckling": "resolve",
    }  # fmt: skip
    return {key: value for key, value in keys.items() if dice.chance(0.1)}


def limits(dice: Dice) -> Raw:
    """How near to its limits the string may be loaded."""
    keys = {"design_factor": dice.number(1, 1.6), "torque_share": dice.number(0.6, 1), "overpull_margin": 2e5}
    return {key: value for key, value in keys.items() if dice.chance(0.3)}


def datum(dice: Dice) -> Raw:
    """The rotary table, on land or at sea."""
    sea = {"air_gap": dice.number(15, 40, 3), "water_depth": dice.number(20, 150, 3)}
    return dice.pick([{}, {}, {"elevation": dice.number(2, 900, 3)}, sea])


def temperature(dice: Dice) -> list[Raw]:
    """Change of the string's temperature by depth."""
    if not dice.chance(0.25):
        return []
    return [{"tvd": 0.0, "change": dice.number(-5, 10)}, {"tvd": dice.number(300, 900), "change": dice.number(10, 60)}]


def record(dice: Dice, total: float) -> Raw:
    """What a run in time records."""
    return {"interval": 2.0, "profile_at": [round(0.9 * total, 1)]} if dice.chance(0.1) else {}


def operations(dice: Dice, depth: float, pumped: float) -> list[Raw]:
    """Operations one after the other; pumped : the largest flow [m³/s]."""
    if not dice.chance(0.5):
        return []
    here, above = depth, round(0.9 * depth, 2)
    rpm, rate = dice.number(40, 120, 3), dice.number(0.002, 0.01)
    run = [
        {"kind": "trip_out", "from_md": here, "to_md": above, "speed": dice.number(0.1, 0.6)},
        {"kind": "trip_in", "from_md": above, "to_md": here, "speed": dice.number(0.1, 0.6)},
        {"kind": "rotate_off_bottom", "at_md": here, "duration": 60.0, "rpm": rpm},
        {"kind": "back_ream", "from_md": here, "to_md": above, "speed": dice.number(0.05, 0.3), "rpm": rpm},
        {"kind": "drill_rotating", "from_md": above, "to_md": 0.5 * (here + above), "speed": rate, "rpm": rpm},
        {"kind": "drill_sliding", "from_md": 0.5 * (here + above), "to_md": here, "speed": rate},
    ]  # fmt: skip
    for operation in run:
        if pumped and dice.chance(0.5):
            operation["flow"] = dice.number(0.3, 1.0) * pumped
        if dice.chance(0.2):
            operation["ramp_time"] = dice.number(2, 20)
    if dice.chance(0.2):
        run[0]["rpm"] = 20.0
        run[1]["rpm"] = 15.0
    return run
