# SPDX-License-Identifier: GPL-3.0-or-later
"""Random inputs, and an independent check of what comes out; shared by the tests and ``benchmarks/fuzz.py``."""
