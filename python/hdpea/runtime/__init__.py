# SPDX-License-Identifier: GPL-3.0-or-later
"""What surrounds a run: progress, interrupts, threads, the clock, processes, and files written whole or not at all."""
