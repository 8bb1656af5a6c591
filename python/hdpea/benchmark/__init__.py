# SPDX-License-Identifier: GPL-3.0-or-later
"""Suites of models, degradations, methods and sizes: run, measured and compared.

>>> from hdpea.benchmark import read_suite, run_suite  # doctest: +SKIP
>>> records = run_suite(read_suite("quick"), "meshes", Path("results"))  # doctest: +SKIP
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from hdpea.runtime.lazy import lazy_names

if TYPE_CHECKING:
    from hdpea.benchmark.gallery import draw_gallery as draw_gallery
    from hdpea.benchmark.record import Record as Record
    from hdpea.benchmark.results import write_results as write_results
    from hdpea.benchmark.run import run_suite as run_suite
    from hdpea.benchmark.suite import Suite as Suite
    from hdpea.benchmark.suite_file import read_suite as read_suite

__all__ = [
    "Record",
    "Suite",
    "draw_gallery",
    "read_suite",
    "run_suite",
    "write_results",
]

__getattr__, __dir__ = lazy_names(
    __name__,
    {
        "Record": "hdpea.benchmark.record",
        "Suite": "hdpea.benchmark.suite",
        "draw_gallery": "hdpea.benchmark.gallery",
        "read_suite": "hdpea.benchmark.suite_file",
        "run_suite": "hdpea.benchmark.run",
        "write_results": "hdpea.benchmark.results",
    },
)
