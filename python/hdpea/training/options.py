# SPDX-License-Identifier: GPL-3.0-or-later
"""The defaults of training, in presets; kept in every checkpoint."""

from __future__ import annotations

from dataclasses import dataclass

from hdpea.errors import UsageError
from hdpea.options import Checked, option
from hdpea.options.device import check_device, device_option

LOSSES = ("local", "ndhde-mae", "ndhde-mse", "point-mse", "point-mae")


@dataclass(frozen=True)
class LossOptions(Checked):
    """The loss (``hdpea.training.losses``)."""

    loss: str = option(
        "local",
        "local: metric, flatness and distances; ndhde-*: distances to neighbours (HD-PEA's); point-*: psi itself",
        choices=LOSSES,
    )
    metric_weight: float = option(1.0, "weight of the metric term in the local loss", minimum=0)
    flatness_weight: float = option(1.0, "weight of the flatness term in the local loss", minimum=0)
    distance_weight: float = option(0.5, "weight of the distance term in the local loss", minimum=0)
    distance_neighbors: int = option(40, "nearest points to which distances are compared", minimum=1)


@dataclass(frozen=True)
class CropOptions(Checked):
    """How crops are cut from clouds (``hdpea.training.crops``)."""

    least_points: int = option(4_000, "points of the smallest crop", minimum=64)
    most_points: int = option(8_000, "points of the largest crop", minimum=64)
    margin: float = option(
        0.15,
        "share of a crop's points, the outermost, that the loss leaves out",
        minimum=0,
        maximum=0.9,
    )
    rotations: str = option(
        "any",
        "any: random rotations and reflections; ten: HD-PEA's; none",
        choices=("any", "ten", "none"),
    )
    least_density: int = option(20_000, "fewest points to which a whole cloud is thinned", minimum=64)
    most_density: int = option(60_000, "most points to which a whole cloud is thinned", minimum=64)
    noisy_share: float = option(0.4, "share of crops with noise added to their points", minimum=0, maximum=1)
    noise: float = option(0.2, "largest standard deviation of that noise, in spacings of the vertices", minimum=0)
    tilted_share: float = option(0.4, "share of crops with noise added to their normals", minimum=0, maximum=1)
    tilt: float = option(0.2, "largest standard deviation of that noise, in radians along each tangent", minimum=0)
    estimated_share: float = option(
        0.5, "share of crops that use estimated normals, where the sample has any", minimum=0, maximum=1
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.least_points > self.most_points or self.least_density > self.most_density:
            raise UsageError("A lower limit is above its upper limit.")


@dataclass(frozen=True)
class TrainingOptions(Checked):
    """How the network is trained (``hdpea.training.loop``)."""

    steps: int = option(60_000, "total optimizer steps; the learning rate falls over them as a cosine", minimum=1)
    epochs: int | None = option(None, "passes over the dataset, instead of steps", minimum=1)
    minutes: float | None = option(
        None, "minutes to train, instead of steps; the learning rate falls by the clock", minimum=0
    )
    batch: int = option(1, "crops per step", minimum=1)
    learning_rate: float = option(2e-3, "highest learning rate of AdamW", minimum=0)
    attention_rate: float = option(2e-3, "highest learning rate of the attention modules", minimum=0)
    warm_up: int = option(200, "steps over which the learning rate rises", minimum=0)
    weight_decay: float = option(0.01, "weight decay of AdamW", minimum=0)
    clip: float = option(1.0, "largest norm of the gradient; 0: unlimited", minimum=0)
    average: float = option(0.999, "decay of the averaged weights per step", minimum=0, maximum=1)
    log_every: int = option(50, "steps between lines of metrics.jsonl", minimum=1)
    save_minutes: float = option(10.0, "minutes between checkpoints", minimum=0)
    validate_every: int = option(2_000, "steps between reconstructions of validation clouds", minimum=1)
    validation_clouds: int = option(4, "validation clouds to reconstruct", minimum=0)
    validation_vertices: int = option(5_180, "vertices of these reconstructions", minimum=4)
    threads: int = option(1, "threads of torch", minimum=1)
    loaders: int = option(
        0, "processes that cut crops, the same for any number; 0: a thread of the training's own", minimum=0
    )
    device: str = device_option("the network is trained")
    seed: int = option(0, "seed of the crops and of the order of the clouds", minimum=0)
    crops: CropOptions = CropOptions()
    loss: LossOptions = LossOptions()

    def __post_init__(self) -> None:
        super().__post_init__()
        check_device(self.device)
        if self.epochs is not None and self.minutes is not None:
            raise UsageError("`epochs` and `minutes` exclude each other.", "Give one of them.")


PRESETS: dict[str, TrainingOptions] = {
    # For two cores and a few hours: one crop per step.
    "cpu": TrainingOptions(),
    # For a GPU that is paid by the minute. Of 16 cores, eight cut more crops than it takes.
    "gpu": TrainingOptions(
        minutes=10, batch=24, learning_rate=3e-3, attention_rate=3e-3, save_minutes=1, validate_every=10**6, loaders=8
    ),
    # HD-PEA paper, appendix E and F: whole clouds of 40,000 points, ten transforms, the distance loss alone.
    "paper": TrainingOptions(
        epochs=5_000,
        batch=16,
        learning_rate=0.01,
        attention_rate=1e-4,
        warm_up=30,
        clip=0,
        crops=CropOptions(
            least_points=40_000,
            most_points=40_000,
            margin=0,
            rotations="ten",
            least_density=40_000,
            most_density=40_000,
            noisy_share=0,
            tilted_share=0,
            estimated_share=1,
        ),
        loss=LossOptions(loss="ndhde-mae"),
    ),
}
"""Training options by name."""
