# SPDX-License-Identifier: GPL-3.0-or-later
"""The former home of ``hdpea.evaluation.evaluate``, for programs that import it from here."""

from __future__ import annotations

from hdpea.evaluation.evaluation import evaluate

__all__ = ["evaluate"]
