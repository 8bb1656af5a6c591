# SPDX-License-Identifier: GPL-3.0-or-later
"""A dataset on disk, to train or to evaluate on."""

from __future__ import annotations

from collections.abc import Iterator
from hashlib import sha256
from pathlib import Path

from hdpea.dataset.manifest import read_manifest
from hdpea.dataset.manifest_options import options_from_manifest
from hdpea.dataset.quality import spacing_of
from hdpea.dataset.sample import Sample
from hdpea.dataset.sample_file import decoded
from hdpea.errors import UnreadableInput, UsageError
from hdpea.geometry.metric import ScaledMetric
from hdpea.reading import read_bytes


class Dataset:
    """The samples in a folder that ``hdpea dataset build`` made; each is checked against the manifest when it is read.

    Parameters
    ----------
    folder
        The folder of its manifest.

    Raises
    ------
    UnreadableInput
        If there is no manifest, or it is damaged or of a newer schema.
    """

    def __init__(self, folder: Path | str) -> None:
        self.folder = Path(folder)
        self.manifest = read_manifest(self.folder)
        self._spacings: dict[str, float] = {}
        self._entries = {each.name: each for each in self.manifest.samples}

    @property
    def names(self) -> list[str]:
        """The names of the samples, in the order of the manifest."""
        return list(self._entries)

    @property
    def metric(self) -> ScaledMetric:
        """The metric of the ground truth, in spacings, as the manifest records it."""
        return options_from_manifest(self.manifest.options).ground_truth.metric

    def __len__(self) -> int:
        return len(self._entries)

    def __iter__(self) -> Iterator[Sample]:
        return map(self.read, self._entries)

    def read(self, name: str, transform: str | None = None) -> Sample:
        """Return a sample, rotated or mirrored by one of the ``TRANSFORMS`` of ``hdpea.dataset.augmentation``.

        Raises
        ------
        UsageError
            If there is no sample or no transform of that name.
        UnreadableInput
            If its file is missing, or has changed since it was built.
        """
        if name not in self._entries:
            raise UsageError(f"There is no sample {name!r} in {self.folder}.", "Dataset.names lists them.")
        entry = self._entries[name]
        data = read_bytes(self.folder / entry.file)
        if sha256(data).hexdigest() != entry.sha256:
            raise UnreadableInput(
                f"{self.folder / entry.file} is not the file that was built: its SHA-256 differs.",
                "`hdpea dataset build` with the same arguments builds it again.",
            )
        sample = decoded(data)
        if transform is None:
            return sample
        from hdpea.dataset.augmentation import TRANSFORMS, augmented

        if transform not in TRANSFORMS:
            raise UsageError(f"There is no transform {transform!r}.", f"There are {', '.join(TRANSFORMS)}.")
        return augmented(sample, TRANSFORMS[transform])

    def spacing(self, name: str) -> float:
        """Return the spacing of a sample, the unit of lengths in the options of its ground truth, in unit length."""
        if name not in self._spacings:
            self._spacings[name] = spacing_of(
                self.read(name), options_from_manifest(self.manifest.options).ground_truth
            )
        return self._spacings[name]

    def augmented(self) -> Iterator[Sample]:
        """Iterate over every sample under every transform, applied on loading; the sample varies slowest."""
        from hdpea.dataset.augmentation import TRANSFORMS

        return (self.read(name, transform) for name in self._entries for transform in TRANSFORMS)
