# SPDX-License-Identifier: GPL-3.0-or-later
"""What became of a mesh that was to be made."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from hdpea.cli.destinations import Destination
from hdpea.errors import HdpeaError

if TYPE_CHECKING:
    from hdpea.report.report import Report


@dataclass(frozen=True)
class Ended:
    """What became of a job: the report, if there is a mesh, and the error, if there was one."""

    sources: tuple[str, ...]
    output: str
    report: dict[str, Any] | None = None
    summary: tuple[str, ...] = ()
    kind: type[HdpeaError] | None = None
    message: str = ""
    hint: str = ""

    @property
    def name(self) -> str:
        """What people call it by."""
        return ", ".join(self.sources)

    @classmethod
    def of(cls, destination: Destination, report: Report | None, error: HdpeaError | None) -> Ended:
        """Sum up a job."""
        from hdpea.report.summary import outcome

        return cls(
            destination.sources,
            destination.name,
            None if report is None else report.as_json(),
            () if report is None else tuple(outcome(report)),
            None if error is None else type(error),
            "" if error is None else error.message,
            "" if error is None else error.hint,
        )

    def as_line(self) -> str:
        """Return one line of JSON."""
        facts = {
            "inputs": self.sources,
            "output": self.output,
            "exit_code": 0 if self.kind is None else self.kind.exit_code,
            "error": self.message or None,
            "hint": self.hint or None,
            "report": self.report,
        }
        return json.dumps(facts)
