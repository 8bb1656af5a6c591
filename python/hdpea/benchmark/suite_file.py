# SPDX-License-Identifier: GPL-3.0-or-later
"""Reading of suites from TOML: those included in hdpea, and others."""

from __future__ import annotations

import tomllib
from collections.abc import Collection, Mapping, Sequence
from dataclasses import fields
from difflib import get_close_matches
from importlib.resources import files
from pathlib import Path
from typing import Any

from hdpea.benchmark.suite import Quoted, Suite, SuiteInput, SuiteMethod, SuiteOptions
from hdpea.dataset.options import DegradationOptions, SampleOptions, ScanOptions
from hdpea.errors import UnreadableInput, UsageError
from hdpea.reading import read_bytes

FROM_THE_SUITE = {"folder", "path", "weights"}
"""Options of methods that are paths relative to the suite, like its folder of meshes."""


def shipped_suites() -> list[str]:
    """Return the names of the suites that are included in hdpea."""
    return sorted(each.name.removesuffix(".toml") for each in _shipped().iterdir() if each.name.endswith(".toml"))


def _shipped() -> Any:
    return files("hdpea.benchmark") / "suites"


def read_suite(name: str, only: Sequence[str] = (), models: int | None = None) -> Suite:
    """Read a suite: one included in hdpea, by its name, or a TOML file.

    Parameters
    ----------
    only
        Names of the methods to take; empty for all.
    models
        Number of models, in place of that of the suite.

    Raises
    ------
    UnreadableInput
        If there is no such suite.
    UsageError
        If it is not TOML, has an unknown key or an illegal value, or no input or method, or none of `only`; if a
        library is missing.
    """
    if name in shipped_suites():
        return _suite(name, (_shipped() / f"{name}.toml").read_text(), Path(str(_shipped())), only, models)
    path = Path(name)
    if path.suffix != ".toml":
        raise UnreadableInput(
            f"There is no suite {name!r}.", f"Suites are {', '.join(shipped_suites())}, or a file that ends in .toml."
        )
    return _suite(path.stem, read_bytes(path).decode("utf-8", errors="replace"), path.parent, only, models)


def _suite(name: str, text: str, folder: Path, only: Sequence[str], models: int | None) -> Suite:
    try:
        content = tomllib.loads(text)
    except (ValueError, RecursionError) as error:
        what = "its values are nested too deep" if isinstance(error, RecursionError) else error
        raise UsageError(f"The suite {name} is not TOML: {what}.", "Lines look like: points = 40_000") from error
    tables = {key: content.pop(key, []) for key in ("input", "method", "quoted")}
    if not (tables["input"] and tables["method"]):
        raise UsageError(f"The suite {name} has no [[input]] or no [[method]].", "It needs at least one of each.")
    if "vertices" in content:
        given = content["vertices"]
        content["vertices"] = tuple(given) if isinstance(given, list) else (given,)
    if models is not None:
        content["models"] = models
    options = SuiteOptions(**_known(content, SuiteOptions, f"The suite {name}"))
    inputs = tuple(_input(each, options) for each in tables["input"])
    methods = tuple(_method(each, folder) for each in _chosen(tables["method"], only, name))
    for kind, names in (("inputs", [each.name for each in inputs]), ("methods", [each.name for each in methods])):
        if len(set(names)) < len(names):
            raise UsageError(f"Two {kind} of the suite {name} have the same name.", "Give each a name of its own.")
    quoted = tuple(Quoted(**_known(each, Quoted, "[[quoted]]")) for each in tables["quoted"])
    return Suite(name, options, inputs, methods, quoted, folder)


def _input(table: dict[str, Any], options: SuiteOptions) -> SuiteInput:
    where = f"The input {table.get('name', '')!r}"
    scan = _known(table.pop("scan", {}), ScanOptions, f"{where}, scan", without=("points", "seed"))
    sample = {key: table.pop(key) for key in ("kind", "estimate") if key in table}
    name = _name(table, where)
    points = _known({"points": table.pop("points", options.points)}, SuiteOptions, where)
    degradation = _known(table, DegradationOptions, where, without=("seed",))
    return SuiteInput(name, SampleOptions(**sample), ScanOptions(**scan, **points), DegradationOptions(**degradation))


def _chosen(tables: Sequence[dict[str, Any]], only: Sequence[str], suite: str) -> list[dict[str, Any]]:
    """Return the tables of these methods, before their libraries are required."""
    names = [str(each.get("name", each.get("method"))) for each in tables]
    for wanted in only:
        if wanted not in names:
            raise UsageError(f"The suite {suite} has no method {wanted!r}.", f"It has {', '.join(map(repr, names))}.")
    return [table for table, name in zip(tables, names, strict=True) if not only or name in only]


def _method(table: dict[str, Any], folder: Path) -> SuiteMethod:
    method = table.pop("method", "")
    if method == "command":
        table.setdefault("folder", ".")
    for key in FROM_THE_SUITE & table.keys():
        table[key] = str(folder / str(table[key]))
    name = str(table.pop("name", method))
    made = SuiteMethod(name, method, table)
    made.options()  # errors are reported before the first run
    return made


def _name(table: dict[str, Any], where: str) -> str:
    if "name" not in table:
        raise UsageError(f"{where} has no name.", 'Add name = "clean", say.')
    return str(table.pop("name"))


def _known(table: Mapping[str, Any], owner: type[Any], where: str, without: Collection[str] = ()) -> dict[str, Any]:
    """Return the table after checking that its keys and types are those of the fields of `owner`."""
    names = [each.name for each in fields(owner) if each.name not in without]
    for key, value in table.items():
        if key not in names:
            near = get_close_matches(key, names, 1, cutoff=0)
            raise UsageError(f"{where} has an unknown key {key!r}.", f"The nearest known key is {near[0]!r}.")
        kinds = _KINDS.get(str(next(each.type for each in fields(owner) if each.name == key)))
        if kinds is not None and type(value) not in kinds:
            raise UsageError(
                f"{where} has {key} = {value!r}.", f"It is {' or '.join(each.__name__ for each in kinds)}."
            )
    return dict(table)


_KINDS: dict[str, tuple[type, ...]] = {
    "str": (str,),
    "bool": (bool,),
    "int": (int,),
    "float": (int, float),
    "float | None": (int, float),
    "tuple[int, ...]": (tuple,),
}
