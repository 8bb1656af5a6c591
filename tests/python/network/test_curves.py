# SPDX-License-Identifier: GPL-3.0-or-later
"""Curves, voxels and patches: what serialises a cloud for attention."""

from __future__ import annotations

import pytest
import torch

from hdpea.network.curves import BITS, CURVES, curve_keys
from hdpea.network.layers import SparseConvolution, patches
from hdpea.network.voxels import Voxels

CUBE = torch.cartesian_prod(*3 * [torch.arange(8)])


@pytest.mark.parametrize("curve", CURVES)
def test_cells_have_keys_of_their_own(curve: str) -> None:
    cells = torch.cat([CUBE, (1 << BITS) - 1 - CUBE])
    keys = curve_keys(cells, curve)
    assert len(torch.unique(keys)) == len(cells)
    assert keys.min() >= 0
    assert keys.max() < 1 << (3 * BITS)


@pytest.mark.parametrize("curve", ["hilbert", "hilbert_transposed"])
def test_the_hilbert_curve_walks_from_neighbour_to_neighbour(curve: str) -> None:
    walk = CUBE[curve_keys(CUBE, curve).argsort()]
    assert (walk.diff(dim=0).abs().sum(dim=1) == 1).all()


def test_the_z_curve_interleaves_bits() -> None:
    assert curve_keys(torch.tensor([[0b11, 0b00, 0b01]]), "z").tolist() == [0b100101]


@pytest.mark.parametrize("curve", ["z", "hilbert"])
def test_the_transposed_curve_is_another(curve: str) -> None:
    assert not torch.equal(curve_keys(CUBE, curve), curve_keys(CUBE, curve + "_transposed"))


def test_voxels_do_not_depend_on_the_order_of_points() -> None:
    generator = torch.Generator().manual_seed(0)
    cells = torch.randint(100, 110, (500, 3), generator=generator)
    batch = (torch.arange(500) >= 200).long()
    order = torch.cat([torch.randperm(200, generator=generator), 200 + torch.randperm(300, generator=generator)])
    voxels, index = Voxels.holding(cells, batch)
    others, other_index = Voxels.holding(cells[order], batch[order])
    assert torch.equal(voxels.cells, others.cells)
    assert torch.equal(index[order], other_index)
    assert torch.equal(voxels.cells[index], cells)
    coarser, up = voxels.coarser()
    assert torch.equal(coarser.cells[up], voxels.cells >> 1)
    assert torch.equal(coarser.batch[up], voxels.batch)


def test_the_sparse_convolution_is_the_dense_one_where_all_voxels_are_occupied() -> None:
    voxels, _ = Voxels.holding(CUBE[(CUBE < 4).all(dim=1)] + 1000, torch.zeros(64, dtype=torch.int64))
    convolution = SparseConvolution(3)
    x = torch.randn(64, 3, generator=torch.Generator().manual_seed(0))
    kernel = convolution.weight.view(3, 3, 3, 3, 3).permute(4, 3, 0, 1, 2)  # out, in, x, y, z
    dense = torch.nn.functional.conv3d(x.T.view(1, 3, 4, 4, 4), kernel, padding=1).view(3, 64).T
    torch.testing.assert_close(convolution(x, voxels), dense)


@pytest.mark.parametrize("counts", [[70], [5], [32], [40, 3, 64]])
def test_patches_hold_every_voxel_and_mix_no_clouds(counts: list[int]) -> None:
    batch = torch.repeat_interleave(torch.tensor(counts))
    order = torch.cat([part[torch.randperm(len(part))] for part in torch.arange(sum(counts)).split(counts)])
    members, real, places = patches(order, torch.tensor(counts), 32)
    assert torch.equal(members.flatten()[places], torch.arange(sum(counts)))
    assert real.flatten()[places].all()
    for patch, exists in zip(members, real, strict=True):
        assert len(batch[patch[exists]].unique()) == 1
