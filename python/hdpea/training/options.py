# SPDX-License-Identifier: GPL-3.0-or-later
"""The defaults of training, in presets; kept in every checkpoint."""

from __future__ import annotations

from dataclasses import dataclass

from hdpea.errors import UsageError
from hdpea.options import Checked, option

LOSSES = ("local", "ndhde-mae", "ndhde-mse", "point-mse", "point-mae")


@dataclass(frozen=True)
class LossOptions(Checked):
    """What the network is trained for (``hdpea.training.losses``)."""

    loss: str = option(
        "local",
        "local: metric, flatness and distances; ndhde-*: distances to neighbours (the paper's); point-*: psi itself",
        choices=LOSSES,
    )
    metric_weight: float = option(1.0, "of the local metric, in the local loss", minimum=0)
    flatness_weight: float = option(1.0, "of the flatness, in the local loss", minimum=0)
    distance_weight: float = option(0.5, "of the distances, in the local loss", minimum=0)
    distance_neighbors: int = option(40, "nearest points that distances are compared to", minimum=1)


@dataclass(frozen=True)
class CropOptions(Checked):
    """What the network is shown of a cloud (``hdpea.training.crops``)."""

    least_points: int = option(4_000, "points of the smallest crop", minimum=64)
    most_points: int = option(8_000, "points of the largest crop", minimum=64)
    margin: float = option(
        0.15, "share of a crop's points, the outermost, that are shown but not judged", minimum=0, maximum=0.9
    )
    rotations: str = option(
        "any", "any: random rotations and reflections; ten: the paper's; none", choices=("any", "ten", "none")
    )
    least_density: int = option(20_000, "points that a whole cloud is thinned to, at least", minimum=64)
    most_density: int = option(60_000, "the same, at most", minimum=64)
    noisy_share: float = option(0.4, "share of crops that get noise on their points", minimum=0, maximum=1)
    noise: float = option(0.2, "largest standard deviation of that noise, in spacings of the vertices", minimum=0)
    tilted_share: float = option(0.4, "share of crops that get noise on their normals", minimum=0, maximum=1)
    tilt: float = option(0.2, "largest standard deviation of that noise, radians in each tangent", minimum=0)
    estimated_share: float = option(
        0.5, "share of crops with estimated normals, where there are any", minimum=0, maximum=1
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.least_points > self.most_points or self.least_density > self.most_density:
            raise UsageError("A least number is more than the most.")


@dataclass(frozen=True)
class TrainingOptions(Checked):
    """How the network is trained (``hdpea.training.loop``)."""

    steps: int = option(60_000, "optimizer steps in all; the learning rate falls along them as a cosine", minimum=1)
    epochs: int | None = option(None, "passes over the dataset, instead of steps", minimum=1)
    batch: int = option(1, "crops in a step", minimum=1)
    learning_rate: float = option(2e-3, "of AdamW, at its highest", minimum=0)
    attention_rate: float = option(2e-3, "the same for the attention modules", minimum=0)
    warm_up: int = option(200, "steps in which the learning rate rises", minimum=0)
    weight_decay: float = option(0.01, "of AdamW", minimum=0)
    clip: float = option(1.0, "largest norm of the gradient; 0: any", minimum=0)
    average: float = option(0.999, "share that the averaged weights keep of themselves in a step", minimum=0, maximum=1)
    log_every: int = option(50, "steps between lines of metrics.jsonl", minimum=1)
    save_minutes: float = option(10.0, "minutes between checkpoints", minimum=0)
    validate_every: int = option(2_000, "steps between reconstructions of validation clouds", minimum=1)
    validation_clouds: int = option(4, "clouds that are reconstructed", minimum=0)
    validation_vertices: int = option(5_180, "vertices that they are reconstructed with", minimum=4)
    threads: int = option(1, "threads of torch", minimum=1)
    seed: int = option(0, "seed of the crops and of the order of the clouds", minimum=0)
    crops: CropOptions = CropOptions()
    loss: LossOptions = LossOptions()


PRESETS: dict[str, TrainingOptions] = {
    # Two cores and some hours: one crop a step.
    "cpu": TrainingOptions(),
    # The paper's (section E): whole clouds of 40,000 points, its ten transforms, its plain loss.
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
"""Trainings by name."""
