# SPDX-License-Identifier: GPL-3.0-or-later
"""Methods that make a mesh of a given size from points: hdpea and others.

A method is a function ``reconstruct(cloud, vertices, options) -> (vertices, faces)`` in a module of its own, or
``surface(cloud, options) -> (vertices, faces)`` if its surface is then reduced. It is listed in ``METHODS`` by name;
its module is imported only in the process that runs it. Other methods need the extra ``benchmark``.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields
from difflib import get_close_matches
from importlib import import_module
from importlib.util import find_spec
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hdpea.benchmark.methods.options import (
    AdvancingFrontOptions,
    BallPivotingOptions,
    Co3neOptions,
    CommandOptions,
    FolderOptions,
    PoissonOptions,
    ReducedOptions,
)
from hdpea.errors import UsageError
from hdpea.geometry.triangles import TriangleMesh
from hdpea.options import Options
from hdpea.options.classes import Classes
from hdpea.options.lengths import Length
from hdpea.options.position import Position
from hdpea.options.settings import options_from, settings


@dataclass(frozen=True)
class Cloud:
    """The input of every method: points (n, 3) in world units and unit normals (n, 3).

    `model` and `given` are the names of the model and of the input in the suite.
    """

    points: NDArray[np.float64]
    normals: NDArray[np.float64]
    model: str
    given: str


@dataclass(frozen=True)
class Method:
    """A method: its module in this package, the class of its options, and the libraries that it requires."""

    module: str
    options: type[Any]
    libraries: tuple[str, ...] = ()

    @property
    def reduces(self) -> bool:
        """Whether it makes a ``surface`` that is then reduced to the wanted number of vertices."""
        return issubclass(self.options, ReducedOptions)

    def load(self, name: str) -> Callable[..., TriangleMesh]:
        """Import the method's function of this name."""
        function: Callable[..., TriangleMesh] = getattr(import_module(f"{__name__}.{self.module}"), name)
        return function


GEOGRAM = ("geogram", "hdpea.benchmark.methods.geogram")

METHODS = {
    "hdpea": Method("ours", Options, ("torch",)),
    "poisson": Method("poisson", PoissonOptions, ("pymeshlab",)),
    "advancing_front": Method("advancing_front", AdvancingFrontOptions, ("CGAL",)),
    "ball_pivoting": Method("ball_pivoting", BallPivotingOptions, ("pymeshlab",)),
    "co3ne": Method("co3ne", Co3neOptions, GEOGRAM),
    "folder": Method("folder", FolderOptions),
    "command": Method("command", CommandOptions),
}
LIBRARIES_OF_REDUCTION = {
    "fast": ("fast_simplification",),
    "quadric": ("pymeshlab",),
    "acvd": ("pyacvd",),
    "cvt": GEOGRAM,
    "mmg": ("mmgpy",),
    "none": (),
}


def method_options(method: str, values: Mapping[str, Any]) -> Any:
    """Return the options of a method from their values by name, as in a suite.

    Raises
    ------
    UsageError
        If there is no such method or option, a value is illegal, or a library is not installed.
    """
    if method not in METHODS:
        raise UsageError(f"There is no method {method!r}.", f"Methods are {', '.join(METHODS)}.")
    owner = METHODS[method].options
    known = [each.name for each in settings()] if owner is Options else [each.name for each in fields(owner)]
    for name in values:
        if name not in known:
            near = get_close_matches(name, known, 1, cutoff=0)
            raise UsageError(f"The method {method} has no option {name!r}.", f"The nearest is {near[0]!r}.")
    options = options_from(_understood(values)) if owner is Options else owner(**values)
    for library in libraries(method, options):
        if find_spec(library) is None:
            raise UsageError(f"The method {method} needs {library}.", "pip install 'hdpea[benchmark]'")
    return options


def libraries(method: str, options: Any) -> tuple[str, ...]:
    """Return the libraries that a method needs with these options."""
    return METHODS[method].libraries + LIBRARIES_OF_REDUCTION[getattr(options, "reduce", "none")]


def _understood(values: Mapping[str, Any]) -> dict[str, Any]:
    """Return settings of a reconstruction with lengths and positions parsed as on the command line."""
    kinds: dict[type, Callable[[str], Any]] = {Length: Length.parse, Position: Position.parse, Classes: Classes.parse}
    parsers = {each.name: kinds[each.kind] for each in settings() if each.kind in kinds}
    try:
        return {name: parsers[name](str(value)) if name in parsers else value for name, value in values.items()}
    except ValueError as error:
        raise UsageError(f"{error}.") from error
