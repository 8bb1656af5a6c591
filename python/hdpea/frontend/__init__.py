# SPDX-License-Identifier: GPL-3.0-or-later
"""What of a raw cloud is surface, and how that is sampled: found before anything else is asked of it."""

from __future__ import annotations

from hdpea.frontend.classifying import Classified as Classified
from hdpea.frontend.classifying import classify as classify
