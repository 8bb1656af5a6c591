# SPDX-License-Identifier: GPL-3.0-or-later
"""Random commands on good and damaged files; a case is known by its seed."""

from __future__ import annotations

import io
import tempfile
import warnings
from collections.abc import Iterator
from contextlib import chdir, redirect_stderr, redirect_stdout
from pathlib import Path
from typing import Any

import numpy as np
from helpers.files import lines, npy, saved
from helpers.fuzzing.cloud_options import settings_at_random
from helpers.fuzzing.cloud_shapes import SHAPES, Random
from helpers.fuzzing.files import DAMAGES, GOOD

from hdpea.cli import run as run_command
from hdpea.network.weights import SHIPPED
from hdpea.writing.placement import placement_file

CODES = {0: "done", 2: "usage", 3: "unreadable", 4: "cannot", 5: "missed"}

NONSENSE = [
    "",
    "abc",
    "nan",
    "inf",
    "-inf",
    "-1",
    "1e400",
    "9" * 30,
    "%",
    "1e308%",
    "0x10",
    "\u0663",
    "1,2",
    "1,2,nan",
    "a\nb",
    "\udcff",
]

OUTPUTS = {
    "reconstruct": ["o.obj", "o.ply", "o.off", "o.stl", "o.glb"],
    "embed": ["o.npz", "o.ply"],
    "curvature": ["o.ply", "o.csv", "o.npz", "o.vtp"],
}

BAD_OUTPUTS = [
    "o.xyz",
    "o",
    "no/such/o.ply",
    ".",
    "in",
    "i" * 251 + ".ply",
    "i" * 300 + ".ply",
    "loop.ply",
    "",
    "\udcff.ply",
]


def _content(random: Random) -> bytes:
    """Return a cloud, or a damaged file."""
    points = SHAPES[random.integers(0, len(SHAPES))](random, int(random.integers(16, 150)))
    clouds = [
        lines(points).encode(),
        npy(points),
        saved(points=points, normals=points[::-1]),
        lines(points, ",").encode(),
    ]
    data = GOOD[random.integers(0, len(GOOD))][1] if random.random() < 0.2 else clouds[random.integers(0, len(clouds))]
    return _damaged(random, data) if random.random() < 0.4 else data


def _damaged(random: Random, data: bytes) -> bytes:
    return DAMAGES[random.integers(0, len(DAMAGES))](random, data)


def _settings(random: Random) -> dict[str, Any]:
    return {
        name: random.choice(NONSENSE) if random.random() < 0.03 else value
        for name, value in settings_at_random(random, 100).items()
    }


def _flags(settings: dict[str, Any]) -> Iterator[str]:
    for name, value in settings.items():
        flag = name.replace("_", "-")
        if isinstance(value, bool):
            yield f"--{flag}" if value or name not in {"watertight", "refine"} else f"--no-{flag}"
        else:
            yield from (f"--{flag}", str(value))


def _toml(settings: dict[str, Any]) -> bytes:
    quoted = {
        name: str(value).lower() if isinstance(value, bool | int | float) else f'"{value}"'
        for name, value in settings.items()
    }
    return "".join(f"{name} = {value}\n" for name, value in quoted.items()).encode("utf-8", "replace")


def arguments_of(random: Random) -> list[str]:
    """Write the input ``in``, and what else the command reads, into this folder; return the command's arguments."""
    Path("in").write_bytes(_content(random))
    Path("loop.ply").symlink_to("loop.ply")
    name = str(random.choice(["info", "reconstruct", "reconstruct", "reconstruct", "embed", "curvature", "evaluate"]))
    source = "in" if random.random() < 0.97 else str(random.choice(["none", ".", "loop.ply", "in/in", ""]))
    if name == "info":
        return [name, source, *(["--json"] if random.random() < 0.5 else [])]
    if name == "evaluate":
        Path("truth.obj").write_bytes(_damaged(random, b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\n"))
        return [name, *(("truth.obj", source) if random.random() < 0.5 else (source, "truth.obj")), "--samples", "200"]
    outputs = OUTPUTS[name] if random.random() < 0.95 else BAD_OUTPUTS
    output = outputs[random.integers(0, len(outputs))]
    flags = list(_flags(_settings(random))) if name == "reconstruct" else ["--vertices", str(random.integers(4, 40))]
    return [name, source, output, *flags, *_files_read(random, name)]


def _files_read(random: Random, name: str) -> Iterator[str]:
    if name == "reconstruct" and random.random() < 0.2:
        Path("run.toml").write_bytes(_damaged(random, _toml(_settings(random))))
        yield from ("--config", "run.toml")
    if name == "reconstruct" and random.random() < 0.1:
        Path("w").write_bytes(_damaged(random, SHIPPED.read_bytes()))
        yield from ("--embedding", "learned", "--weights", "w")
    if name == "reconstruct" and random.random() < 0.2:
        yield from (
            "--report",
            str(random.choice(["r.json", "in", "o.ply", "no/r.json", "r.txt"], p=[0.6, *[0.1] * 4])),
        )


def _files() -> dict[str, bytes]:
    """Return the files of this folder, and what is in them."""
    return {str(each): each.read_bytes() for each in Path().iterdir() if each.is_file()}


def run(seed: int) -> str:
    """Run the command of a seed in a folder of its own; return how it ended, by its exit code.

    Raises
    ------
    AssertionError
        If it ends with another exit code than the documented ones, without exactly one sentence where it fails, or
        leaves files behind that nobody asked for.
    """
    random = np.random.default_rng([seed, 4])
    told, said = io.StringIO(), io.StringIO()
    with tempfile.TemporaryDirectory() as folder, chdir(folder):
        arguments = arguments_of(random)
        before = _files()
        with warnings.catch_warnings(), redirect_stderr(told), redirect_stdout(said):
            warnings.simplefilter("error")
            code = run_command(arguments)
        after = _files()
    command = " ".join(arguments).encode("utf-8", "backslashreplace").decode()
    assert code in CODES, f"{command}: exit code {code}: {told.getvalue()[told.getvalue().find('Error: ') :]}"
    errors = told.getvalue().count("Error: ")
    assert errors == (code != 0), f"{command}: exit code {code}, {errors} errors told"
    assert all(after.get(each) == content for each, content in before.items()), f"{command}: an input was changed"
    made = set(after) - set(before)
    wanted = {*arguments} | {str(placement_file(Path(each))) for each in arguments if Path(each).name}
    assert made <= wanted, f"{command}: left {made}"
    assert code in {0, 5} or not made, f"{command}: failed, and left {made}"
    return CODES[code]
