"""The case file as JSON Schema, for editors that complete and check TOML."""

from typing import Any, Final

from fctd.case.load import Case
from fctd.case.operation_names import names_of
from fctd.case.operations import KINDS

DIALECT: Final = "https://json-schema.org/draft/2020-12/schema"


def case_schema() -> dict[str, Any]:
    """JSON Schema of a case file.  Rules across keys are not in it; `load_case` checks them."""
    schema = Case.model_json_schema()
    del schema["properties"]["file"]  # of stored cases alone
    for name, kind in KINDS.items():
        table = schema["$defs"][kind.__name__]
        table["required"].remove(kind.start_key)  # from the second operation on it may be left out
        table["properties"]["kind"] = {"enum": [*names_of(name)]}
    return {"$schema": DIALECT, "title": "Case of FCTD"} | {k: v for k, v in schema.items() if k != "title"}
