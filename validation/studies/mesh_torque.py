"""Fig. 13 as a driller would measure it: torque off bottom with contact on a mesh and in cylinders."""

from fctd import torque_drag
from references import contact
from validation.cases import load, rotation
from validation.harness.study import Check, Context, Outcome, Study
from validation.parts.contact_presets import in_loop, windows

DEPTHS = (1850.0, 1950.0, 2050.0, 2150.0, 2250.0)
METHOD = "fcl"
RAMP = 2.0  # [s]
CURVE = [float(depth) for depth in range(1750, 2251, 25)]
AGREE = 2.0  # percent


def run(context: Context) -> Outcome:
    """Windows with both methods, from the same start, at each depth; the engine's steady torque."""
    if contact.installed_version(METHOD) is None:
        return Outcome({}, [], [f"Not installed, and so not run: {contact.method_class(METHOD).distribution}."])
    found = {
        f"rotating_{depth:.0f}_m": in_loop(
            load("paper_well", operations=rotation(depth, 1.0, RAMP)), ["cylinders", METHOD], context
        )
        for depth in context.progress(DEPTHS, "depths")
    }
    table = windows(found, METHOD)
    return Outcome(
        tables={"windows": table, "steady": torque_drag(load("paper_well"), "rotate_off_bottom", CURVE)},
        checks=[
            Check(f"{words} rotating, FCL against FCTD, largest difference",
                  float(table[f"{column}_difference_percent"].abs().max(skipna=False)), AGREE, "at_most", "%",
                  "facets: 0.2 %")
            for words, column in (("torque", "torque"), ("Σ rμF_n", "sum"))
        ],
        notes=[
            "The string turns under law coulomb. FCTD's own stepper leads it to one start, and contact with FCL, a "
            "mesh of 48 facets with rings every 2 m at most, and with FCTD's cylinders has it from there. Both are "
            "averaged over the same whole periods of its twist, two in a full run.",
            "Reading (a) of Fig. 13, Σ rμF_n while tripping in, is in the study contact_swap.",
        ],
        display={"windows": "Torque rotating off bottom with FCL and with cylinders, over the same windows"},
        comparisons=found,
    )  # fmt: skip


STUDY = Study(
    "mesh_torque",
    "Does the torque off bottom depend on the contact method?",
    run,
    reproduce=True,
)
