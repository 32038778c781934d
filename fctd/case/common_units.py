"""Factors of the units that cases, tables and messages commonly have, so that they need no unit registry."""

from collections.abc import Mapping
from typing import Final

# By target and unit, both in pint's words, each the number that pint gives to 15 digits; a test compares them.  To
# import pint and build its registry takes half a second.
COMMON: Final[Mapping[str, Mapping[str, float]]] = {
    "m": {"mm": 0.001, "cm": 0.01, "km": 1000.0, "foot": 0.3048, "inch": 0.0254, "ft": 0.3048, "in": 0.0254},
    "s": {"ms": 0.001, "min": 60.0, "minute": 60.0, "h": 3600.0},
    "m/s": {
        "m/min": 0.0166666666666667, "m/h": 0.000277777777777778, "ft/s": 0.3048, "ft/min": 0.00508,
        "ft/h": 8.46666666666667e-05,
    },
    "rpm": {"rad/s": 9.54929658551372, "turn/s": 60.0},
    "rad": {"deg": 0.0174532925199433, "degree": 0.0174532925199433},
    "N": {
        "daN": 10.0, "kN": 1000.0, "MN": 1000000.0, "kgf": 9.80665, "lbf": 4.4482216152605, "klbf": 4448.2216152605,
        "kilodecanewton": 10000.0,
    },
    "N*m": {
        "(N*m)": 1.0, "(kN*m)": 1000.0, "(daN*m)": 10.0, "kN*m": 1000.0, "daN*m": 10.0, "ft*lbf": 1.3558179483314,
        "lbf*ft": 1.3558179483314, "kft*lbf": 1355.8179483314,
    },
    "Pa": {
        "MPa": 1000000.0, "GPa": 1000000000.0, "bar": 100000.0, "psi": 6894.75729316836, "ksi": 6894757.29316836,
        "kPa": 1000.0, "lbf/hsqft": 0.478802589803359,
    },
    "K": {"degR": 0.555555555555556},
    "K^-1": {"K**-1": 1.0, "degR**-1": 1.8},
    "kg/m^3": {
        "kg/m**3": 1.0, "g/cm**3": 1000.0, "specific_gravity": 1000.0, "(pound/gallon)": 119.826427316897,
        "lb/gal": 119.826427316897, "lb/ft**3": 16.0184633739601,
    },
    "kg/m": {"(pound/foot)": 1.48816394356955, "lb/ft": 1.48816394356955},
    "N/m": {"kN/m": 1000.0, "MN/m": 1000000.0, "lbf/in": 175.126835246476, "lbf/ft": 14.5939029372064},
    "N/m^2": {"N/m/m": 1.0, "N/m**2": 1.0, "kN/m/m": 1000.0, "MN/m/m": 1000000.0},
    "N*m^2": {"N*m**2": 1.0, "kN*m**2": 1000.0, "lbf*ft**2": 0.413253310651411},
    "N*s/m": {"kN*s/m": 1000.0, "lbf*s/ft": 14.5939029372064},
    "N*s/m^2": {"N*s/m**2": 1.0, "lbf*s/ft**2": 47.8802589803359},
    "kN*m": {"N*m": 0.001},
    "kft*lbf": {"N*m": 0.000737562149277265, "kN*m": 0.737562149277265},
    "MPa": {"Pa": 1e-06},
    "ksi": {"Pa": 1.45037737730209e-07, "MPa": 0.145037737730209},
    "kN": {"N": 0.001},
    "klbf": {"N": 0.00022480894309971, "kN": 0.224808943099711},
    "ft": {"m": 3.28083989501312, "km": 3280.83989501312},
    "mm": {"m": 1000.0},
    "in": {"m": 39.3700787401575, "mm": 0.0393700787401575},
    "ft/min": {"m/s": 196.850393700787},
    "ft/h": {"m/h": 3.28083989501312},
    "lbf": {"N": 0.224808943099711},
    "lb/gal": {"kg/m^3": 0.00834540445201933},
    "lb/ft": {"kg/m": 0.671968975139507},
}  # fmt: skip
