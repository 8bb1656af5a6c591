# SPDX-License-Identifier: GPL-3.0-or-later
"""Training: the same wherever it is stopped, and in as many processes as you like."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import torch
from helpers.networks import METRIC, QUICK, SPACING, TINY, InMemory, network_of, predicted, torus_sample, unit_torus

from hdpea.errors import Interrupted, UnreadableInput, UsageError
from hdpea.geometry.unit_frame import UnitFrame
from hdpea.network.weights import UNRECORDED_METRIC, read_weights, write_weights
from hdpea.surface.surface import Surface
from hdpea.training.checkpoint import FORMAT, Checkpoint
from hdpea.training.crops import crop_number, cut_crop
from hdpea.training.joined import Joined
from hdpea.training.loaders import StepCrops, prefetched
from hdpea.training.loop import train
from hdpea.training.options import PRESETS, CropOptions, LossOptions, TrainingOptions
from hdpea.training.packed import Packed, write_packed
from hdpea.training.steps import Training, learning_share
from hdpea.training.stopping import stop_requests
from hdpea.training.validation import mesh_of_embedding, metric_quality, validate


def same(first: object, second: object) -> bool:
    """Whether nested containers hold the same tensors to the last bit."""
    if isinstance(first, torch.Tensor) and isinstance(second, torch.Tensor):
        return torch.equal(first, second)
    if isinstance(first, dict) and isinstance(second, dict):
        return first.keys() == second.keys() and all(same(first[key], second[key]) for key in first)
    if isinstance(first, list | tuple) and isinstance(second, list | tuple):
        return len(first) == len(second) and all(map(same, first, second))
    return first == second


def stop_after(steps: int) -> object:
    calls = iter(range(1, 1000))
    return lambda: next(calls) >= steps


def test_a_training_that_was_stopped_ends_as_one_that_was_not(tmp_path: Path) -> None:
    straight, stopped = tmp_path / "straight", tmp_path / "stopped"
    straight.mkdir()
    stopped.mkdir()
    train(InMemory(), None, straight, TINY, QUICK)
    with pytest.raises(Interrupted):
        train(InMemory(), None, stopped, TINY, QUICK, stop_after(5))
    assert Checkpoint.read(stopped / "last.pt").step == 5
    train(InMemory(), None, stopped, TINY, QUICK)
    first, second = (Checkpoint.read(folder / "last.pt") for folder in (straight, stopped))
    assert same(vars(first), vars(second))


def test_packed_samples_are_those_packed_to_sixteen_bits(tmp_path: Path) -> None:
    noisy = torus_sample(300)
    noisy = replace(noisy, points=noisy.points + np.float32(0.01), estimated_normals=-noisy.normals)
    samples = InMemory({"clean": torus_sample(400), "noisy": noisy})
    write_packed(tmp_path / "packed.safetensors", samples)
    packed = Packed(tmp_path / "packed.safetensors")
    assert (packed.names, packed.metric, packed.spacing("noisy")) == (samples.names, METRIC, SPACING)
    for name in samples.names:
        given, read = samples.read(name), packed.read(name)
        order = np.argmin(np.linalg.norm(given.points[:, None] - read.points, axis=2), axis=0)
        assert sorted(order) == list(range(len(given.points)))
        for column in ("points", "surface_points", "normals", "psi"):
            np.testing.assert_allclose(getattr(read, column), getattr(given, column)[order], atol=2e-5)
    assert packed.read("clean").estimated_normals is None
    np.testing.assert_allclose(read.estimated_normals, -read.normals, atol=4e-5)
    assert train(packed, None, tmp_path, TINY, replace(QUICK, steps=1)).step == 1


def test_what_is_not_packed_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "packed.safetensors"
    write_weights(path, network_of())
    with pytest.raises(UnreadableInput, match="no packed samples"):
        Packed(path)
    write_packed(path, InMemory())
    path.write_bytes(path.read_bytes()[:500])
    with pytest.raises(UnreadableInput, match="Cannot read"):
        Packed(path)


class Clock:
    """Tells a second more each time."""

    def __init__(self) -> None:
        self.seconds = 0.0

    def __call__(self) -> float:
        self.seconds += 1
        return self.seconds


def test_a_training_of_minutes_ends_by_the_clock_with_the_rate_down_and_resumes(tmp_path: Path) -> None:
    straight, stopped = tmp_path / "straight", tmp_path / "stopped"
    straight.mkdir()
    stopped.mkdir()
    options = replace(QUICK, minutes=0.2, save_minutes=0.1)
    ended = train(InMemory(), None, straight, TINY, options, clock=Clock())
    assert (ended.step, ended.seconds, ended.done) == (12, 12, 1)
    assert max(group["lr"] for group in ended.optimizer.param_groups) < 0.1 * options.learning_rate
    with pytest.raises(Interrupted):
        train(InMemory(), None, stopped, TINY, options, stop_after(5), clock=Clock())
    train(InMemory(), None, stopped, TINY, options, clock=Clock())
    first, second = (Checkpoint.read(folder / "last.pt") for folder in (straight, stopped))
    assert same(vars(first), vars(second))


def test_whoever_reads_the_folder_meanwhile_finds_whole_files(tmp_path: Path) -> None:
    seen: list[int] = []

    def look() -> bool:
        if (tmp_path / "last.pt").exists():
            seen.append(Checkpoint.read(tmp_path / "last.pt").step)
            assert read_weights(tmp_path / "last.safetensors").options == TINY
        return False

    train(InMemory(), None, tmp_path, TINY, replace(QUICK, steps=4, save_minutes=0), look)
    assert seen == [1, 2, 3]


def test_any_number_of_loaders_cuts_the_same_crops_in_the_same_order() -> None:
    crops = [list(prefetched(StepCrops(InMemory(), replace(QUICK, loaders=count), 16), 3, 6)) for count in (0, 2)]
    for first, *others in zip(*crops, strict=True):
        assert all(same(vars(first.truth), vars(each.truth)) for each in others)
        assert all(same(vars(first.clouds), vars(each.clouds)) for each in others)


def test_a_training_starts_from_given_weights(tmp_path: Path) -> None:
    trained = train(InMemory(), None, tmp_path, TINY, replace(QUICK, steps=3)).averaged_network()
    training = Training(InMemory(), TINY, QUICK)
    training.start_from(trained)
    assert same(dict(training.averaged_network().state_dict()), dict(trained.state_dict()))
    with pytest.raises(UsageError, match="another network"):
        training.start_from(network_of(replace(TINY, smoothing=5)))


def test_the_loss_falls(tmp_path: Path) -> None:
    from_nothing = replace(TINY, normal_share=0.0)
    train(InMemory(), None, tmp_path, from_nothing, replace(QUICK, steps=60, log_every=10, learning_rate=0.01))
    lines = [json.loads(line) for line in (tmp_path / "metrics.jsonl").read_text().splitlines()]
    assert [line["step"] for line in lines] == [10, 20, 30, 40, 50, 60]
    assert lines[-1]["loss"] < 0.8 * lines[0]["loss"]


@pytest.mark.parametrize("loss", ["ndhde-mae", "ndhde-mse", "point-mse", "point-mae"])
def test_every_loss_trains(loss: str, tmp_path: Path) -> None:
    options = replace(QUICK, steps=2, loss=LossOptions(loss=loss))
    assert train(InMemory(), None, tmp_path, TINY, options).step == 2


def test_half_precision_trains_as_full_does() -> None:
    # What a GPU runs, on a CPU.
    parts = {}
    for half in (False, True):
        training = Training(InMemory(), TINY, QUICK)
        training.half = half
        parts[half] = training.run_step(training.crops[0])
        assert all(value.dtype == torch.float32 for value in training.network.state_dict().values())
    assert parts[True] != parts[False]
    assert parts[True] == pytest.approx(parts[False], rel=0.03)


def test_other_options_are_refused_but_for_the_steps(tmp_path: Path) -> None:
    train(InMemory(), None, tmp_path, TINY, replace(QUICK, steps=2))
    assert train(InMemory(), None, tmp_path, TINY, replace(QUICK, steps=3)).step == 3
    with pytest.raises(UsageError, match="other options"):
        train(InMemory(), None, tmp_path, TINY, replace(QUICK, batch=4))
    with pytest.raises(UsageError, match="other options"):
        train(InMemory(), None, tmp_path, replace(TINY, smoothing=5), QUICK)


OTHER_METRIC = replace(METRIC, scale=20.0)


def test_the_metric_is_that_of_the_samples_and_comes_along_with_the_weights(tmp_path: Path) -> None:
    validation = InMemory({"torus": torus_sample(2000)}, metric=OTHER_METRIC)
    options = replace(QUICK, steps=1, validation_vertices=200)
    train(InMemory(metric=OTHER_METRIC), validation, tmp_path, TINY, options)
    assert Checkpoint.read(tmp_path / "last.pt").build().metric == OTHER_METRIC
    assert read_weights(tmp_path / "best.safetensors").metric == OTHER_METRIC


def test_another_metric_is_refused(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="metric of the validation set"):
        train(InMemory(), InMemory(metric=OTHER_METRIC), tmp_path, TINY, QUICK)
    with pytest.raises(UsageError, match="metric of another dataset"):
        Joined([InMemory(), InMemory(metric=OTHER_METRIC)])
    with pytest.raises(UsageError, match="scale of 0"):
        train(InMemory(metric=replace(METRIC, scale=0.0)), None, tmp_path, TINY, QUICK)
    train(InMemory(), None, tmp_path, TINY, replace(QUICK, steps=1))
    with pytest.raises(UsageError, match="samples of another metric"):
        train(InMemory(metric=OTHER_METRIC), None, tmp_path, TINY, QUICK)


def test_a_checkpoint_that_records_no_metric_still_loads(tmp_path: Path) -> None:
    train(InMemory(), None, tmp_path, TINY, replace(QUICK, steps=1))
    content = torch.load(tmp_path / "last.pt", weights_only=True)
    del content["metric"]
    torch.save(content, tmp_path / "last.pt")
    assert Checkpoint.read(tmp_path / "last.pt").build().metric == UNRECORDED_METRIC
    assert train(InMemory(), None, tmp_path, TINY, replace(QUICK, steps=2)).step == 2


def test_validation_reconstructs_and_keeps_the_best(tmp_path: Path) -> None:
    validation = InMemory({"torus": torus_sample(2000)})
    train(InMemory(), validation, tmp_path, TINY, replace(QUICK, steps=2, validation_vertices=200))
    last = json.loads((tmp_path / "metrics.jsonl").read_text().splitlines()[-1])
    best = Checkpoint.read(tmp_path / "best.pt")
    assert best.best == last["validation_score"]
    sample = validation.read("torus")
    # Training had one thread, which sums in another order.
    assert validate(best.build(), [(sample, SPACING)], 200)["score"] == pytest.approx(best.best, rel=1e-3)
    assert np.isfinite(predicted(best.build(), *unit_torus())).all()


def test_meshes_of_the_metric_are_better_than_others() -> None:
    sample = torus_sample(4000)
    points, normals = np.asarray(sample.points, float), np.asarray(sample.normals, float)
    u = np.stack([-points[:, 1], points[:, 0]], axis=1)
    along = np.hstack([u / np.linalg.norm(u, axis=1, keepdims=True), np.zeros((4000, 1))])
    around = replace(
        sample,
        curvatures=np.tile(np.float32([8.0, 1.0]), (4000, 1)),
        direction1=np.float32(np.cross(normals, along)),
    )
    across = replace(around, direction1=np.float32(along))
    surface = Surface.of(UnitFrame(np.zeros(3), 1.0), points, normals)
    mesh = mesh_of_embedding(surface, 0.3 * np.pad(normals, ((0, 0), (0, 2))), 300)
    assert 0.5 < metric_quality(mesh, around).mean() <= 1
    assert metric_quality(mesh, around).mean() > metric_quality(mesh, across).mean()


def test_crops_are_functions_of_their_number_and_take_turns() -> None:
    options = replace(QUICK.crops, noisy_share=1.0, tilted_share=1.0)
    first, again = (crop_number(4, InMemory(), options, 16, 0) for _ in range(2))
    assert same(vars(first.truth), vars(again.truth))
    assert same(vars(first.clouds), vars(again.clouds))
    read: list[str] = []
    samples = InMemory()
    samples.read = lambda name: (read.append(name), torus_sample())[1]  # type: ignore[method-assign]
    for number in range(6):
        crop_number(number, samples, options, 16, 0)
    assert sorted(read[:3]) == sorted(read[3:]) == samples.names


def test_datasets_are_joined_one_after_the_other() -> None:
    first, second = InMemory(), InMemory({"0": torus_sample(100), "other": torus_sample(200)})
    joined = Joined([first, second])
    assert len(set(joined.names)) == 5
    assert [len(joined.read(name).points) for name in joined.names] == [400, 400, 400, 100, 200]


def test_crops_are_what_was_asked_for() -> None:
    options = CropOptions(least_points=100, most_points=150, margin=0.2, noisy_share=0, tilted_share=0)
    crop = cut_crop(torus_sample(1000), SPACING, options, 16, np.random.default_rng(0))
    count = len(crop.truth.points)
    assert 100 <= count <= 150
    assert crop.clouds.neighbors.shape == (count, 16)
    assert (crop.truth.weights > 0).sum() == int(0.8 * count)
    assert crop.truth.weights.sum().item() == pytest.approx(1)
    # Distances are as they were, whatever way the cloud was turned; psi's first columns turned with it.
    torch.testing.assert_close(crop.truth.psi[:, :3], 0.2 / SPACING * crop.truth.normals, rtol=0, atol=1e-5)
    torch.testing.assert_close(crop.clouds.normals, crop.truth.normals)


def test_noise_moves_what_is_seen_and_not_the_truth() -> None:
    options = CropOptions(least_points=100, most_points=150, noisy_share=1, tilted_share=1, rotations="none")
    crop = cut_crop(torus_sample(1000), SPACING, options, 16, np.random.default_rng(0))
    seen, true = (each - each.mean(dim=0) for each in (crop.clouds.points, crop.truth.points))
    assert 0 < (seen - true).norm(dim=1).mean() < 0.5
    assert 0.9 < (crop.clouds.normals * crop.truth.normals).sum(dim=1).mean() < 1


def test_a_thinned_cloud_has_the_density_asked_for() -> None:
    options = CropOptions(least_points=5000, most_points=5000, least_density=100, most_density=100)
    crop = cut_crop(torus_sample(1000), SPACING, options, 16, np.random.default_rng(0))
    assert 60 < len(crop.truth.points) < 140


def test_the_learning_rate_rises_and_falls() -> None:
    shares = [learning_share(step, 10, max(step - 10, 0) / 90) for step in range(100)]
    assert shares[0] == pytest.approx(0.1)
    assert max(shares) == shares[10] == 1
    assert shares[-1] < 0.01


def test_the_paper_s_preset_is_the_paper_s() -> None:
    paper = PRESETS["paper"]
    assert (paper.learning_rate, paper.attention_rate, paper.batch, paper.epochs) == (0.01, 1e-4, 16, 5000)
    training = Training(InMemory(), TINY, replace(paper, batch=2))
    assert training.steps == 5000 * 2
    assert [group["full_rate"] for group in training.optimizer.param_groups] == [0.01, 1e-4]
    assert PRESETS["cpu"] == TrainingOptions()


def test_an_empty_dataset_is_refused() -> None:
    with pytest.raises(UsageError, match="no samples"):
        Training(InMemory({}), TINY, QUICK)


@pytest.mark.parametrize(
    "damage", ["missing", "truncated", "text", "other", "format", "parts", "weights", "tensors", "network", "metric"]
)
def test_a_damaged_checkpoint_is_told_apart(damage: str, tmp_path: Path) -> None:
    path = tmp_path / "last.pt"
    if damage != "missing":
        train(InMemory(), None, tmp_path, TINY, replace(QUICK, steps=1))
        content = torch.load(path, weights_only=True)
    if damage == "truncated":
        path.write_bytes(path.read_bytes()[:2000])
    elif damage == "text":
        path.write_text("no checkpoint")
    elif damage == "other":
        torch.save([1, 2], path)
    elif damage == "format":
        torch.save(content | {"format": FORMAT + 1}, path)
    elif damage == "parts":
        del content["optimizer"]
        torch.save(content, path)
    elif damage == "weights":
        torch.save(content | {"averaged": {"other": torch.zeros(1)}}, path)
    elif damage == "tensors":
        torch.save(content | {"averaged": [1, 2]}, path)
    elif damage == "network":
        torch.save(content | {"network": content["network"] | {"depths": (100_000, 1)}}, path)
    elif damage == "metric":
        torch.save(content | {"metric": content["metric"] | {"scale": float("nan")}}, path)
    with pytest.raises(UnreadableInput):
        Checkpoint.read(path).build()


def test_ctrl_c_is_a_request() -> None:
    before = signal.getsignal(signal.SIGINT)
    with stop_requests() as stopped:
        assert not stopped()
        os.kill(os.getpid(), signal.SIGINT)
        assert stopped()
    assert signal.getsignal(signal.SIGINT) is before


@pytest.mark.slow
def test_two_processes_learn_what_one_does(tmp_path: Path) -> None:
    start = network_of(TINY).state_dict()
    alone = train(InMemory(), None, tmp_path, TINY, QUICK).network.state_dict()
    together = tmp_path / "together"
    together.mkdir()
    torchrun = [sys.executable, "-m", "torch.distributed.run", "--standalone", "--nproc-per-node", "2"]
    environment = os.environ | {"OMP_NUM_THREADS": "1"}
    subprocess.run([*torchrun, "-m", "helpers.training_together", together], env=environment, check=True, timeout=300)
    weights = Checkpoint.read(together / "last.pt").weights
    apart = torch.cat([(weights[name] - value).flatten() for name, value in alone.items()])
    moved = torch.cat([(start[name] - value).flatten() for name, value in alone.items()])
    # Adam moves a weight as far for a gradient of 1e-12 as for one of 1, so a few follow rounding.
    assert apart.norm() < 0.02 * moved.norm()
