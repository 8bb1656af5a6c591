# SPDX-License-Identifier: GPL-3.0-or-later
"""Point Transformer V3 (Wu et al. 2024) in plain PyTorch: from points and normals to psi."""

from __future__ import annotations

import torch
from torch import Tensor, nn

from hdpea.geometry.metric import ScaledMetric
from hdpea.network.averaging import Neighborhoods, averaged
from hdpea.network.clouds import Clouds
from hdpea.network.curves import CURVES
from hdpea.network.layers import Block, Linear, full_precision, rows
from hdpea.network.options import NetworkOptions
from hdpea.network.stem import EdgeStem
from hdpea.network.voxels import MIDDLE, Voxels

EDGE = 0.4
"""Unit of the stem's lengths, in spacings: about the distance to the 5th neighbour, with 8 points per vertex."""

FLAT = 0.02
"""Curvature, 1 / spacing, below which the metric does not stretch."""

OUTPUTS = 5
"""The dimensions of psi."""

PSI_STEP, GATE_STEP = 3.5, 0.25
"""By how much an output of 1 changes psi, in spacings, and the gate, relatively; the effects are about equal."""

FIRST_OUTPUTS = 0.1
"""Factor on the initial weights of the outputs: what an untrained network adds to the normals is noise."""

ORIGIN = 0.381966
"""Where the centre of a cloud lies in its voxel: no plane of symmetry should lie between voxels."""


class PointTransformer(nn.Module):
    """The network: features of points, a U-Net of voxels, psi of points.

    It sees coordinates only relative to a neighbour or a voxel, so its output does not depend on where a crop lies.
    The initial weights depend on ``options.seed`` alone.

    Attributes
    ----------
    options
        The shape of the network.
    metric
        The metric that it is trained on, in spacings. The layers do not depend on it; whoever uses psi does.
    """

    def __init__(self, options: NetworkOptions, metric: ScaledMetric) -> None:
        super().__init__()
        self.options, self.metric = options, metric
        with torch.random.fork_rng(devices=[]):
            torch.manual_seed(options.seed)
            self._build(options)

    def _build(self, o: NetworkOptions) -> None:
        self.stem = EdgeStem(o.stem_channels, o.neighbors) if o.stem else None
        point_channels = 6 + 12 * o.shape + o.stem_channels * o.stem
        self.enter = _mapped(point_channels, o.channels[0])
        self.down = nn.ModuleList(_mapped(*pair) for pair in zip(o.channels, o.channels[1:], strict=False))
        self.encoder = nn.ModuleList(self._blocks(*each) for each in zip(o.channels, o.depths, strict=True))
        below = (*o.decoder_channels[1:], o.channels[-1])
        self.up = nn.ModuleList(_mapped(*pair) for pair in zip(below, o.decoder_channels, strict=True))
        skips = zip(o.channels, o.decoder_channels, strict=False)
        self.across = nn.ModuleList(_mapped(*pair) for pair in skips)
        decoder = zip(o.decoder_channels, o.decoder_depths, strict=True)
        self.decoder = nn.ModuleList(self._blocks(*each) for each in decoder)
        width = o.decoder_channels[0] if o.decoder_channels else o.channels[0]
        self.leave = _mapped(width + point_channels, width)
        self.affine = Linear(width, OUTPUTS * 4)
        self.psi = Linear(width, OUTPUTS)
        self.gate = Linear(width, 1) if o.normal_gate else None
        with torch.no_grad():
            for last in (self.affine, self.psi, self.gate):
                if last is not None:
                    last.weight *= FIRST_OUTPUTS

    def _blocks(self, channels: int, depth: int) -> nn.ModuleList:
        o = self.options
        return nn.ModuleList(Block(channels, o.head_width, o.patch_size, o.mlp_ratio) for _ in range(depth))

    def forward(self, clouds: Clouds) -> Tensor:
        """Return psi (n, 5) float32 of the points, in spacings."""
        with full_precision(clouds.points):
            voxels, index, features = self._points(clouds)
        x = self._unet(_pooled(self.enter(features), index, len(voxels.cells)), voxels)
        left = self.leave(torch.cat([rows(x, index), features], dim=1))
        with full_precision(features):
            # psi varies as much within a voxel as between voxels: each predicts an affine map, and points correct it.
            maps = rows(self.affine(x.float()), index).view(-1, OUTPUTS, 4)
            offsets = nn.functional.pad(features[:, :3], (0, 1), value=1)  # (n, 4)
            psi = PSI_STEP * (self.psi(left.float()) + (maps @ offsets[:, :, None])[:, :, 0])  # (n, 5)
            return self._smooth(psi, left.float(), clouds)

    def _smooth(self, psi: Tensor, x: Tensor, clouds: Clouds) -> Tensor:
        """Add the normals to psi (n, 5), as much of them as the features x (n, c) say, and average over neighbours."""
        around = Neighborhoods.of(clouds.points, clouds.normals, clouds.neighbors[:, : self.options.neighbors])
        averaging = around.averaging()
        share = self.options.normal_share
        if share:
            # Facets and noise make normals jump, which psi never does.
            normals = clouds.normals
            for _ in range(self.options.normal_rounds):
                normals = averaged(normals, around.members, averaging)
            # On a cylinder of radius r, the solution is the normal times sqrt(c r - r^2).
            gate = share * (1 + GATE_STEP * self.gate(x)) if self.gate is not None else share
            psi = psi + nn.functional.pad(gate * normals, (0, OUTPUTS - 3))
        # The output varies from point to point more than psi can, and meshing needs tangent planes that agree.
        for _ in range(self.options.smoothing):
            psi = averaged(psi, around.members, averaging)
        return psi

    def _points(self, clouds: Clouds) -> tuple[Voxels, Tensor, Tensor]:
        """Return the finest voxels, that of each point (n,), and the features of points (n, c)."""
        places = clouds.points / self.options.voxel + ORIGIN  # (n, 3)
        cells = places.floor()
        voxels, index = Voxels.holding(cells.long() + MIDDLE, clouds.batch)
        features = [places - cells - 0.5, clouds.normals]
        if self.options.shape:
            size = (clouds.shape.square() @ clouds.shape.new_tensor([1, 1, 1, 2, 2, 2])).sqrt()  # Frobenius norm
            # The gradient of psi is proportional to the square root of the curvature.
            features += [clouds.shape, clouds.shape / (size + FLAT).sqrt()[:, None]]
        if self.stem is not None:
            features.append(self.stem(clouds.points / EDGE, clouds.normals, clouds.neighbors))
        return voxels, index, torch.cat(features, dim=1)

    def _unet(self, x: Tensor, voxels: Voxels) -> Tensor:
        """Map features (v, c) of the finest voxels to those of the decoder (v, c)."""
        skips: list[tuple[Tensor, Voxels, Tensor]] = []
        curves = self._curves()
        for level, blocks in enumerate(self.encoder):
            if level:
                coarser, index = voxels.coarser()
                skips.append((x, voxels, index))
                x, voxels = _pooled(self.down[level - 1](x), index, len(coarser.cells)), coarser
            x = self._run(blocks, x, voxels, curves)
        for level in reversed(range(len(skips))):
            skip, voxels, index = skips[level]
            x = rows(self.up[level](x), index) + self.across[level](skip)
            x = self._run(self.decoder[level], x, voxels, curves)
        return x

    def _curves(self) -> list[int]:
        """Return the order in which blocks use the curves: shuffled in training, otherwise as listed."""
        if not self.training:
            return list(range(len(CURVES)))
        shuffled: list[int] = torch.randperm(len(CURVES)).tolist()
        return shuffled

    @staticmethod
    def _run(blocks: nn.Module, x: Tensor, voxels: Voxels, curves: list[int]) -> Tensor:
        for turn, block in enumerate(blocks.children()):
            x = block(x, voxels, voxels.orders[curves[turn % len(curves)]])
        return x


def _mapped(inputs: int, outputs: int) -> nn.Sequential:
    return nn.Sequential(Linear(inputs, outputs), nn.LayerNorm(outputs), nn.GELU())


def _pooled(x: Tensor, index: Tensor, count: int) -> Tensor:
    """Return the mean (count, c) of the features (n, c) in each voxel."""
    sums = torch.zeros(count, x.shape[1], device=x.device).index_add(0, index, x.float())
    return sums / torch.bincount(index, minlength=count)[:, None]
