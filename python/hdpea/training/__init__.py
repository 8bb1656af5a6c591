# SPDX-License-Identifier: GPL-3.0-or-later
"""Training the learned embedding on clouds whose true embedding is known."""
