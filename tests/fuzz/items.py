"""The fuzzer's inputs: a case file as bytes, the files beside it, and overrides as typed."""

from dataclasses import dataclass, field


@dataclass(frozen=True)
class Item:
    """One input.

    content : of the case file; files : those beside it, by name; overrides : "key=value".
    plausible : made to be a well that can be drilled, so that its answers have to pass the checks of mechanics.
    simulated : plausible, and run for a few seconds as well.
    """

    content: bytes
    files: dict[str, bytes] = field(default_factory=dict)
    overrides: tuple[str, ...] = ()
    plausible: bool = False
    simulated: bool = False
