# SPDX-License-Identifier: GPL-3.0-or-later
"""The shape of a network. It is kept in every checkpoint, so that weights rebuild the network they belong to."""

from __future__ import annotations

from dataclasses import dataclass

from hdpea.errors import UsageError
from hdpea.options import Checked, option


@dataclass(frozen=True)
class NetworkOptions(Checked):
    """A Point Transformer V3; one entry of each tuple per level of the U-Net, the finest first."""

    channels: tuple[int, ...] = option((64, 128, 192), "width of the encoder at each level")
    depths: tuple[int, ...] = option((1, 1, 2), "blocks of the encoder at each level")
    decoder_channels: tuple[int, ...] = option((64, 128), "width of the decoder at each level but the coarsest")
    decoder_depths: tuple[int, ...] = option((1, 1), "blocks of the decoder at each level but the coarsest")
    head_width: int = option(16, "channels of an attention head", minimum=1)
    patch_size: int = option(256, "voxels that attend to each other", minimum=1)
    mlp_ratio: int = option(2, "width inside a block's MLP, in its own width", minimum=1)
    voxel: float = option(1.0, "side of the finest voxels, in spacings; doubles at each level", minimum=1e-6)
    neighbors: int = option(16, "nearest points that stem and averages look at", minimum=1)
    shape: bool = option(True, "the shape operator, fitted to the normals, is a feature of each point")
    stem: bool = option(False, "edge convolutions on nearest neighbours before the first pooling")
    stem_channels: int = option(32, "width of the edge convolutions", minimum=1)
    normal_share: float = option(14.0, "psi is this times the normal, in spacings, plus what is learned", minimum=0)
    normal_gate: bool = option(True, "that share is learned point by point, and only begins so")
    normal_rounds: int = option(2, "times the normals are averaged over neighbours before that", minimum=0)
    smoothing: int = option(4, "times psi is averaged over neighbours, as the last layer", minimum=0)
    seed: int = option(0, "seed of the first weights", minimum=0)

    def __post_init__(self) -> None:
        super().__post_init__()
        levels = len(self.channels)
        given = (len(self.depths), len(self.decoder_channels) + 1, len(self.decoder_depths) + 1)
        if given != (levels, levels, levels):
            raise UsageError(
                "A network has a depth for each level, and a decoder for each level but the coarsest.",
                f"{levels} channels ask for {levels} depths and {levels - 1} channels and depths of the decoder.",
            )
        if any(width % self.head_width for width in (*self.channels, *self.decoder_channels)):
            raise UsageError(f"Channels are multiples of head_width, {self.head_width}.")


CONFIGURATIONS: dict[str, NetworkOptions] = {
    # What a CPU can train and run.
    "compact": NetworkOptions(),
    # The sizes of the backbone that the paper names (PTv3, Wu et al. 2024, semantic segmentation).
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
