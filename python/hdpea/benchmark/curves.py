# SPDX-License-Identifier: GPL-3.0-or-later
"""Plots of error against the size of a mesh, one curve for each method, as SVG."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from html import escape

import numpy as np

WIDTH, HEIGHT = 620, 400
LEFT, RIGHT, TOP, BOTTOM = 70, 200, 34, 50
COLORS = ("#1d4ed8", "#c2410c", "#15803d", "#7e22ce", "#be123c", "#0e7490", "#a16207", "#475569")
FONT = 'font-family="sans-serif" font-size="12"'

Curve = Sequence[tuple[float, float]]
"""Size, in vertices or triangles, and error."""


def draw_curves(title: str, unit: str, curves: Mapping[str, Curve], size: str = "vertices") -> str:
    """Return a plot of curves by name on logarithmic axes, as SVG: size to the right, error upwards.

    Parameters
    ----------
    unit
        Label of the vertical axis.
    curves
        Positive numbers; a name without points is left out.
    size
        Label of the horizontal axis.
    """
    shown = {name: sorted(curve) for name, curve in curves.items() if curve}
    points = np.log10(np.array([point for curve in shown.values() for point in curve]))
    low, high = points.min(axis=0) - 0.05, points.max(axis=0) + 0.05

    def place(size: float, error: float) -> tuple[float, float]:
        share = (np.log10([size, error]) - low) / (high - low)
        return LEFT + share[0] * (WIDTH - LEFT - RIGHT), HEIGHT - BOTTOM - share[1] * (HEIGHT - TOP - BOTTOM)

    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT}" viewBox="0 0 {WIDTH} {HEIGHT}">',
        f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>',
        f'<text x="{LEFT}" y="20" {FONT} font-weight="bold">{escape(title)}</text>',
        f'<text x="{(LEFT + WIDTH - RIGHT) / 2}" y="{HEIGHT - 10}" text-anchor="middle" {FONT}>{escape(size)}</text>',
        f'<text transform="translate(16 {HEIGHT / 2}) rotate(-90)" text-anchor="middle" {FONT}>{escape(unit)}</text>',
    ]
    for axis in (0, 1):
        for value in _ticks(float(low[axis]), float(high[axis])):
            x, y = place(*((value, 10 ** low[1]) if axis == 0 else (10 ** low[0], value)))
            end = (x, TOP) if axis == 0 else (WIDTH - RIGHT, y)
            parts.append(f'<path d="M{x:.1f} {y:.1f}L{end[0]:.1f} {end[1]:.1f}" stroke="#e2e2e2"/>')
            where = f'x="{x:.1f}" y="{y + 16:.1f}" text-anchor="middle"'
            if axis == 1:
                where = f'x="{x - 6:.1f}" y="{y + 4:.1f}" text-anchor="end"'
            parts.append(f"<text {where} {FONT}>{value:,.10g}</text>")
    for i, (name, curve) in enumerate(shown.items()):
        color = COLORS[i % len(COLORS)]
        placed = [place(*point) for point in curve]
        path = "L".join(f"{x:.1f} {y:.1f}" for x, y in placed)
        parts.append(f'<path d="M{path}" fill="none" stroke="{color}" stroke-width="2"/>')
        parts += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3.5" fill="{color}"/>' for x, y in placed]
        row = TOP + 10 + 20 * i
        parts.append(f'<rect x="{WIDTH - RIGHT + 14}" y="{row - 9}" width="12" height="12" fill="{color}"/>')
        parts.append(f'<text x="{WIDTH - RIGHT + 32}" y="{row + 2}" {FONT}>{escape(name)}</text>')
    return "\n".join([*parts, "</svg>"])


def _ticks(low: float, high: float) -> list[float]:
    """Return round numbers between two powers of ten: 1, 2 and 5 of each, or 1 alone where these are enough."""
    powers = range(int(np.floor(low)), int(np.ceil(high)) + 1)
    steps = (1, 2, 5) if high - low < 3 else (1,)
    values = [step * 10.0**power for power in powers for step in steps]
    return [value for value in values if low <= np.log10(value) <= high]
