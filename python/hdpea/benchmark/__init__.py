# SPDX-License-Identifier: GPL-3.0-or-later
"""Suites of models, degradations, methods and sizes, run and measured by one command."""
