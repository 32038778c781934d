"""What a reader of the numbers of ``engines_agree`` has to know."""

from validation.harness.study import left_out


def notes(missing: list[str], lead: float, well_lead: float, ramp: float) -> list[str]:
    """Notes; lead, well_lead : how long FCTD's stepper runs first, in paper-well too [s]; ramp : of its start [s]."""
    return [
        *left_out(missing),
        f"Every engine starts from the same state: FCTD's stepper after {lead:g} s ({well_lead:g} s in paper-well), "
        "in motion; the rows over the step start from FCTD's frictionless shape at rest. All numbers are means under "
        "a Hann window. A run that fails a check is marked invalid and its numbers are kept.",
        "The axial ringing of a sliding string does not decay, in paper-well with a period of 2.06 s: Coulomb "
        f"friction does not depend on speed and does not damp it. Paper-well is therefore started over {ramp:g} s, "
        "which leaves 0.3 % of ringing in the hook load, and whole periods are used to check that the hook load has "
        "settled.",
        "No engine was set with FCTD's loads: the step of each is the best of its ladder by one definition; MuJoCo's "
        "contact parameters are those that give Coulomb's law for a pipe in a straight hole. Changes since a first "
        "round, whose settings had been chosen with FCTD's torque in view: MuJoCo without its contact margin of 5 mm "
        "and with impedance 0.3 in place of 0.5; Bullet with the hole along its own axes (default: the global ones); "
        "PyElastica with a step of 0.45 in place of 1.03 ms. Errors of ours corrected since: PyElastica's string "
        "lacked the weight of pipe fed before the window (0.4 % of hook load in trips), its nodes were offset from "
        "its open joints, and its ledger lacked the work of the drive on the clamped element.",
        "Bullet's friction is not opposite to the sliding: Bullet solves it along two directions that follow from "
        "the wall's normal and its axes, each over the body's effective mass along it, so that friction opposes M·v "
        "in place of v. The table of friction shows this angle, the lean: 32° in a straight hole at 15° to the axes, "
        "as those masses predict, and zero along an axis. With its z axis across the plane of the hole Bullet "
        "agrees; in a hole that turns no axes fit all of it, and part of the lean remains. Tried and rejected: "
        "bodies in maximal coordinates, whose friction follows the sliding but has a separate μN in the second "
        "direction. The note of a row gives the share of μN that opposes the sliding, measured on its own contacts, "
        "where it is below 98 %.",
        "The S-shaped well was added after the engines had been set, with nothing changed since. In arcs the spacing "
        "of the rings of Bullet's and MuJoCo's tube follows from a chord tolerance of 0.5 mm; with rings only at the "
        "ends of the arcs, as before, the tube cut through the bends and the string left it within 0.2 s.",
        "MuJoCo's default friction cone is a pyramid along fixed directions and leans as much as Bullet's; its fair "
        "configuration uses the elliptic cone. Its friction is a soft constraint, and contact chatters on a wall as "
        "stiff as the case's.",
        "Bullet, MuJoCo and PyElastica integrate spinning bodies with an explicit gyroscopic moment, which adds "
        "energy: at FCTD's own step Bullet's and MuJoCo's string leaves the hole within 10 s, and PyElastica's at "
        "0.9 ms gains 18 % of the work, at half of that 0.3 %. In PyElastica wall and friction are our code: its "
        "agreement verifies only the beam and the integrator. While tripping its upper end is lowered, no pipe is "
        "fed.",
        "Rows of the 1000:1 model with Bullet are computed in millimetres, as a user of Adams would do: fixed limits "
        "and tolerances in Bullet's units make both fail, and the checks report it. The steady solver cannot solve "
        "the naive model at a thousandth (see its row); it solves it at full size with steel a thousand times as "
        "stiff, which is the same by similarity; at a tenth both ways are computed and agree. A second route, which "
        "needs neither solver nor similarity, is the stepper: it runs the naive model at a thousandth of the size, "
        "with wall and dampers of a small string.",
    ]
