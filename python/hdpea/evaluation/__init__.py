# SPDX-License-Identifier: GPL-3.0-or-later
"""How good a mesh is, measured against the true surface: one definition of every score, used everywhere.

>>> from hdpea.evaluation import evaluate, read_truth  # doctest: +SKIP
>>> evaluate(vertices, faces, read_truth(Path("true.ply")))  # doctest: +SKIP
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from hdpea.runtime.lazy import lazy_names

if TYPE_CHECKING:
    from hdpea.evaluation.evaluation import evaluate as evaluate
    from hdpea.evaluation.options import EvaluationOptions as EvaluationOptions
    from hdpea.evaluation.scores import Evaluation as Evaluation
    from hdpea.evaluation.table import describe as describe
    from hdpea.evaluation.truth import Truth as Truth
    from hdpea.evaluation.truth import read_truth as read_truth
    from hdpea.evaluation.truth import truth_of_mesh as truth_of_mesh
    from hdpea.evaluation.truth import truth_of_points as truth_of_points

__all__ = [
    "Evaluation",
    "EvaluationOptions",
    "Truth",
    "describe",
    "evaluate",
    "read_truth",
    "truth_of_mesh",
    "truth_of_points",
]

__getattr__, __dir__ = lazy_names(
    __name__,
    {
        "Evaluation": "hdpea.evaluation.scores",
        "EvaluationOptions": "hdpea.evaluation.options",
        "Truth": "hdpea.evaluation.truth",
        "describe": "hdpea.evaluation.table",
        "evaluate": "hdpea.evaluation.evaluation",
        "read_truth": "hdpea.evaluation.truth",
        "truth_of_mesh": "hdpea.evaluation.truth",
        "truth_of_points": "hdpea.evaluation.truth",
    },
)
