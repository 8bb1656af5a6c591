# SPDX-License-Identifier: GPL-3.0-or-later
"""Print what a cloud in tiles takes, by who works on it, and whether seams show.

    python benchmarks/tile_table.py --shape bumps --points 40000 --tile-points 24000 --jobs 1 2 4 --cluster

The cloud is an analytic shape with its normals, in a binary PLY file. A row is a run in a process of its own: processor
and wall-clock time, largest memory of a process, the first digits of a digest of vertices and faces, and the seams:
the root mean square distance of points within two spacings of the vertices of a seam from the mesh, by that of all
others. Seams are where tiles meet, and the rims within which each was finished. With ``--whole`` the first row is the
cloud in one piece, as if it had the same seams.

With ``--cluster`` a Dask cluster of two workers works on the tiles, of which one is killed when half of the particles
are placed. It needs ``dask[distributed]``.
"""

from __future__ import annotations

import argparse
import hashlib
import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hdpea import _core, read_points, reconstruct
from hdpea.geometry.unit_frame import UnitFrame
from hdpea.options import Options
from hdpea.reading.streaming import CHUNK, stream_of
from hdpea.result import Reconstruction
from hdpea.tiling.cells import Cells
from hdpea.tiling.plan import Plan, plan_tiles
from hdpea.tiling.run import Tiling, reconstruct_in_tiles

SHAPES = Path(__file__).resolve().parent.parent / "examples" / "shapes.py"

Vectors = NDArray[np.float64]

NEAR = 2.0
"""How near to a seam counts, in spacings of the vertices."""


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--shape", default="knot", help="one of examples/shapes.py")
    parser.add_argument("--points", type=int, default=40_000)
    parser.add_argument("--tile-points", type=int, default=24_000)
    parser.add_argument("--jobs", type=int, nargs="*", default=[1, 2, 4])
    parser.add_argument("--cluster", action="store_true")
    parser.add_argument("--whole", action="store_true", help="in one piece as well")
    asked = parser.parse_args()
    print(
        "| worked on by | tiles | processor s | wall-clock s | largest process, MB | vertices | closed, genus |", end=""
    )
    print(" rms, 1e-3 spacings | farthest | seam / elsewhere | digest |")
    print("|---" * 11 + "|")
    rows: list[Any] = [*(["whole"] if asked.whole else []), *asked.jobs, *(["cluster"] if asked.cluster else [])]
    with tempfile.TemporaryDirectory() as folder:
        cloud = Path(folder) / "cloud.ply"
        subprocess.run([sys.executable, SHAPES, asked.shape, cloud, "--points", str(asked.points)], check=True)
        for who in rows:
            with ProcessPoolExecutor(1, get_context("spawn")) as alone:
                print("| " + " | ".join(alone.submit(row, who, cloud, asked.tile_points).result()) + " |", flush=True)


def row(who: int | str, cloud: Path, most: int) -> list[str]:
    """Return a row of the table: of one piece, so many processes, or a cluster."""
    started = time.perf_counter()
    if who == "whole":
        result = reconstruct(read_points(cloud))
        busy = time.process_time()
    else:
        result = tiled(cloud, who, most)
        busy = sum(each.seconds for each in result.report.clock.stages if each.level == 1)
    wall = time.perf_counter() - started
    peak = result.report.clock.total().peak_bytes
    mesh, points = result.report.mesh, read_points(cloud).points
    plan = planned(points, most)
    tiles = str(result.report.counts.get("tiles", 1))
    names = {"whole": "one piece", "cluster": "Dask, 2 workers, one killed"}
    name = names.get(str(who), f"{who} processes" if who != 1 else "1 process")
    digest = hashlib.sha256(result.vertices.tobytes() + result.faces.tobytes()).hexdigest()[:8]
    distances = result.report.distances
    rms, farthest = (f"{1000 * each / distances.spacing:.1f}" for each in (distances.rms, distances.max))
    closed = f"{'yes' if mesh.closed else 'no'}, {mesh.genus}"
    ratio = f"{seam_ratio(points, result, plan):.3f}"
    took = [f"{busy:.0f}", f"{wall:.0f}", f"{peak / 1e6:.0f}"]
    return [name, tiles, *took, f"{mesh.vertices:,}", closed, rms, farthest, ratio, digest]


def tiled(cloud: Path, who: int | str, most: int) -> Reconstruction:
    """Make the mesh of a cloud in tiles."""
    stream = stream_of(cloud)
    if stream is None:
        raise SystemExit(f"{cloud} cannot be streamed.")
    with tempfile.TemporaryDirectory() as folder:
        tiling = Tiling(Path(folder) / "work", 0, tile_points=most)
        if isinstance(who, int):
            return reconstruct_in_tiles(stream, replace(tiling, jobs=who))
        from distributed import LocalCluster

        with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:
            threading.Thread(target=kill_one, args=(cluster, tiling.folder), daemon=True).start()
            return reconstruct_in_tiles(stream, replace(tiling, scheduler=cluster.scheduler_address))


def kill_one(cluster: Any, folder: Path) -> None:
    """Kill a worker of a cluster as soon as a tile has its particles."""
    while not any(folder.glob("particles.*")):
        time.sleep(0.05)
    worker = next(iter(cluster.workers.values()))
    os.kill(worker.process.pid, signal.SIGKILL)


def planned(points: Vectors, most: int) -> Plan:
    """Return the tiles that a cloud is cut into."""
    frame = UnitFrame.around(points)
    pieces = (frame.to_unit(points[start : start + CHUNK]) for start in range(0, len(points), CHUNK))
    return plan_tiles(Cells.of(pieces), frame, Options(), most)


def seam_ratio(points: Vectors, result: Reconstruction, plan: Plan) -> float:
    """Return the root mean square distance of points near a seam from the mesh, by that of all others."""
    distances = _core.closest_surface_points(result.vertices, result.faces, points).distance
    corners = result.vertices[result.faces]
    area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1).sum() / 2
    near = NEAR * np.sqrt(area / len(result.vertices)) / plan.frame.diagonal
    at_seam = at_seams(plan, plan.frame.to_unit(points), near)
    return float(np.sqrt((distances[at_seam] ** 2).mean() / (distances[~at_seam] ** 2).mean()))


def at_seams(plan: Plan, points: Vectors, near: float) -> NDArray[np.bool_]:
    """Return which points in the unit frame (n, 3) lie near to where tiles meet, or to the rim that each has."""
    seams = np.zeros(len(points), dtype=bool)
    for tile in range(plan.tiles):
        for reach in (0.0, plan.collar):
            seams |= plan.inside(tile, points, reach + near) & ~plan.inside(tile, points, reach - near)
    return seams


if __name__ == "__main__":
    main()
