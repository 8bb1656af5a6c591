# SPDX-License-Identifier: GPL-3.0-or-later
"""The shape of a network. It is stored in every checkpoint, so that weights rebuild the network they belong to."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any

from hdpea.errors import UsageError
from hdpea.options import Checked, option

LEVELS = 10
"""The most levels of a U-Net: there are 16 bits of a voxel's coordinate, and a level takes one."""

WIDEST, DEEPEST = 4096, 64
"""The most channels, and blocks of a level: far beyond any use, so that a damaged file cannot ask for more."""


@dataclass(frozen=True)
class NetworkOptions(Checked):
    """A Point Transformer V3; one entry of each tuple per level of the U-Net, the finest first.

    Raises
    ------
    UsageError
        If a number is out of range, or the tuples do not fit each other.
    """

    channels: tuple[int, ...] = option((64, 128, 192), "width of the encoder at each level")
    depths: tuple[int, ...] = option((1, 1, 2), "blocks of the encoder at each level")
    decoder_channels: tuple[int, ...] = option((64, 128), "width of the decoder at each level but the coarsest")
    decoder_depths: tuple[int, ...] = option((1, 1), "blocks of the decoder at each level but the coarsest")
    head_width: int = option(16, "channels of an attention head", minimum=1, maximum=WIDEST)
    patch_size: int = option(256, "voxels that attend to each other", minimum=1, maximum=65_536)
    mlp_ratio: int = option(2, "width inside a block's MLP, as a multiple of the block's", minimum=1, maximum=64)
    voxel: float = option(
        1.0, "side of the finest voxels, in spacings; doubles at each level", minimum=1e-6, maximum=1e6
    )
    neighbors: int = option(16, "nearest points that stem and averages look at", minimum=1, maximum=1024)
    shape: bool = option(True, "the shape operator, fitted to the normals, is a feature of each point")
    stem: bool = option(False, "edge convolutions on nearest neighbours before the first pooling")
    stem_channels: int = option(32, "width of the edge convolutions", minimum=1, maximum=WIDEST)
    normal_share: float = option(
        14.0, "psi is this times the normal, in spacings, plus what is learned", minimum=0, maximum=1e6
    )
    normal_gate: bool = option(True, "that factor is learned point by point, and is only where training starts")
    normal_rounds: int = option(
        2, "times the normals are averaged over neighbours before that", minimum=0, maximum=1000
    )
    smoothing: int = option(4, "times psi is averaged over neighbours, as the last layer", minimum=0, maximum=1000)
    seed: int = option(0, "seed of the first weights", minimum=0, maximum=2**63 - 1)

    def __post_init__(self) -> None:
        super().__post_init__()
        levels = len(self.channels)
        given = (len(self.depths), len(self.decoder_channels) + 1, len(self.decoder_depths) + 1)
        if given != (levels, levels, levels):
            raise UsageError(
                "A network has a depth for each level, and a decoder for each level but the coarsest.",
                f"{levels} channels ask for {levels} depths and {levels - 1} channels and depths of the decoder.",
            )
        if not 1 <= levels <= LEVELS:
            raise UsageError(f"A network has 1 to {LEVELS} levels, not {levels}.")
        widths = (*self.channels, *self.decoder_channels)
        if not all(1 <= width <= WIDEST and width % self.head_width == 0 for width in widths):
            raise UsageError(f"Channels are multiples of head_width, {self.head_width}, and at most {WIDEST}.")
        if not all(0 <= depth <= DEEPEST for depth in (*self.depths, *self.decoder_depths)):
            raise UsageError(f"Depths are from 0 to {DEEPEST}.")

    @classmethod
    def of_record(cls, values: object) -> NetworkOptions:
        """Return the options that a file holds as a mapping by name; lists count as tuples.

        What is missing has its default, so that older files can be read.

        Raises
        ------
        ValueError
            If it is no such mapping, or a value is of another type.
        UsageError
            If a value is out of range.
        """
        if not isinstance(values, Mapping):
            raise ValueError("its options are no mapping of values by name")
        defaults = {each.name: each.default for each in fields(cls)}
        unknown = sorted(str(name) for name in values if name not in defaults)
        if unknown:
            raise ValueError(f"a network has no {unknown[0][:40]}")
        return cls(**{name: _as_recorded(name, value, defaults[name]) for name, value in values.items()})


def _as_recorded(name: str, value: Any, default: Any) -> Any:
    """Return a value of the type of its default."""
    if isinstance(default, tuple):
        if isinstance(value, list | tuple) and len(value) <= LEVELS and all(map(_is_whole, value)):
            return tuple(value)
        raise ValueError(f"{name} is a list of up to {LEVELS} whole numbers")
    if isinstance(default, bool):
        if isinstance(value, bool):
            return value
        raise ValueError(f"{name} is true or false")
    if _is_whole(value) or (isinstance(default, float) and isinstance(value, float)):
        return value
    raise ValueError(f"{name} is a {'number' if isinstance(default, float) else 'whole number'}")


def _is_whole(value: object) -> bool:
    return isinstance(value, int) and not isinstance(value, bool)


CONFIGURATIONS: dict[str, NetworkOptions] = {
    # What a CPU can train and run.
    "compact": NetworkOptions(),
    # The sizes of the backbone that the HD-PEA paper (appendix E) names: those of PTv3 for semantic segmentation.
    "base": NetworkOptions(
        channels=(32, 64, 128, 256, 512),
        depths=(2, 2, 2, 6, 2),
        decoder_channels=(64, 64, 128, 256),
        decoder_depths=(2, 2, 2, 2),
        patch_size=1024,
        mlp_ratio=4,
        voxel=0.28,
        shape=False,
        normal_share=0.0,
        normal_gate=False,
        smoothing=0,
    ),
}
"""Networks by name."""
