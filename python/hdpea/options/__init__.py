# SPDX-License-Identifier: GPL-3.0-or-later
"""One options dataclass per stage: the only home of every default.

The command line, the Python signatures and the report read these fields; ``help`` is the text that
``hdpea reconstruct --help`` shows. An illegal value is a ``UsageError`` the moment it is given.
These modules import nothing heavy, so that help stays instant.
"""

from __future__ import annotations

from hdpea.options.checked import Checked as Checked
from hdpea.options.checked import option as option
from hdpea.options.classes import Classes as Classes
from hdpea.options.cleaning import CleaningOptions as CleaningOptions
from hdpea.options.denoising import DenoisingOptions as DenoisingOptions
from hdpea.options.embedding import EmbeddingOptions as EmbeddingOptions
from hdpea.options.lengths import Length as Length
from hdpea.options.meshing import MeshingOptions as MeshingOptions
from hdpea.options.normals import NormalOptions as NormalOptions
from hdpea.options.particles import ParticleOptions as ParticleOptions
from hdpea.options.position import Position as Position
from hdpea.options.reconstruction import Options as Options
from hdpea.options.refinement import RefinementOptions as RefinementOptions
