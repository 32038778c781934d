"""Rivals: contact methods and engines of packages with an environment of their own (``make rivals``, ``rivals.lock``).

Their classes can be imported without their packages.  A rival that is not installed is a row ``not installed`` in
lists and tables.  Nothing of the suite imports this module: registries find it by name, studies of rivals import it.
"""

METHODS: dict[str, str] = {
    "embree": "references.contact.embree:Embree",
    "warp": "references.contact.warp:Warp",
    "rapier": "references.contact.rapier:Rapier",
}

ENGINES: dict[str, str] = {
    "exudyn": "references.engines.exudyn:Exudyn",
    "rapier": "references.engines.rapier:Rapier",
}
