# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run tells about itself: the report, its summary, facts of a cloud, the cost of a run."""
