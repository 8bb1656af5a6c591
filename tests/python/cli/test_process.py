# SPDX-License-Identifier: GPL-3.0-or-later
"""The command as a process of its own: start-up, standard input, Ctrl-C."""

from __future__ import annotations

import os
import resource
import shlex
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from helpers import clouds, standins
from helpers.files import WITH_NORMALS

HEAVY = ("torch", "numpy", "vtk", "trimesh", "pyvista", "rich", "hdpea._core")


def test_help_imports_nothing_heavy() -> None:
    check = (
        f"import sys; from hdpea.cli import run; assert run(sys.argv[1:]) == 0; print(set({HEAVY}) & set(sys.modules))"
    )
    for arguments in (
        ["--help"],
        ["reconstruct", "--help"],
        ["curvature", "--help"],
        ["train", "--help"],
        ["--version"],
        ["evaluate", "--help"],
        ["benchmark", "--help"],
        ["dataset", "--help"],
        *(["dataset", command, "--help"] for command in ("build", "scan", "degrade", "info", "show")),
    ):
        ran = subprocess.run([sys.executable, "-c", check, *arguments], capture_output=True, text=True, check=True)
        assert ran.stdout.endswith("set()\n")


def test_help_is_quick() -> None:
    def seconds_of_children() -> float:
        # Processor time, since a busy machine makes any command wait.
        usage = resource.getrusage(resource.RUSAGE_CHILDREN)
        return usage.ru_utime + usage.ru_stime

    before = seconds_of_children()
    subprocess.run([sys.executable, "-m", "hdpea", "--help"], capture_output=True, check=True)
    assert seconds_of_children() - before < 0.3


def test_every_flag_is_in_the_help_with_its_stage() -> None:
    from hdpea.options.settings import settings

    ran = subprocess.run(
        [sys.executable, "-m", "hdpea", "reconstruct", "-h"], capture_output=True, text=True, check=True
    )
    for each in settings():
        assert "--" + each.name.replace("_", "-") in ran.stdout
        assert each.stage.capitalize() + ":\n" in ran.stdout


def stand_in(*arguments: str | Path) -> list[str]:
    return [sys.executable, "-m", "helpers.standins", *map(str, arguments)]


def command(*arguments: str | Path) -> list[str]:
    return [sys.executable, "-m", "hdpea", *map(str, arguments)]


@pytest.mark.slow
def test_a_pipe_makes_a_mesh_and_says_nothing_if_quiet(tmp_path: Path) -> None:
    script = command("reconstruct", "-", tmp_path / "mesh.obj", "--quiet")
    ran = subprocess.run(script, input=WITH_NORMALS["text.ply"], capture_output=True, check=True)
    assert (ran.stdout, ran.stderr) == (b"", b"")
    assert (tmp_path / "mesh.obj").read_text().count("v ") == 12


def test_no_arguments_show_the_help_and_are_wrong_usage() -> None:
    ran = subprocess.run([sys.executable, "-m", "hdpea"], capture_output=True, text=True, check=False)
    assert ran.returncode == 2
    assert "reconstruct" in ran.stderr


def shell(redirection: str, script: list[str]) -> subprocess.CompletedProcess[str]:
    line = f"{shlex.join(script)} {redirection}"
    return subprocess.run(["/bin/sh", "-c", line], capture_output=True, text=True, check=False)


@pytest.mark.parametrize("redirection", ["2>&-", "2>/dev/full", "2>&- >&- <&-"])
def test_progress_that_cannot_be_written_costs_no_mesh(redirection: str, tmp_path: Path) -> None:
    (tmp_path / "scan.ply").write_bytes(WITH_NORMALS["binary.ply"])
    ran = shell(redirection, stand_in("reconstruct", tmp_path / "scan.ply", tmp_path / "mesh.obj"))
    assert ran.returncode == 0
    assert (tmp_path / "mesh.obj").read_text().count("f ") == 1


@pytest.mark.parametrize("redirection", [">&-", ">/dev/full"])
def test_a_result_that_cannot_be_written_is_an_error(redirection: str) -> None:
    ran = shell(redirection, command("--version"))
    assert ran.returncode == 2
    assert ran.stderr.startswith("Error: Cannot write to standard output: ")
    assert "Hint: " in ran.stderr


def test_a_standard_input_that_is_closed_is_an_error() -> None:
    ran = shell("<&-", command("info", "-"))
    assert ran.returncode == 3
    assert ran.stderr.startswith("Error: Cannot read standard input: it is closed.")


def test_standard_input_takes_no_harm_either(tmp_path: Path) -> None:
    (tmp_path / "in.json").write_bytes(WITH_NORMALS["plain.xyz"])
    script = stand_in("reconstruct", "-", tmp_path / "mesh.obj", "--report", tmp_path / "in.json")
    ran = shell(f"<{tmp_path / 'in.json'}", script)
    assert ran.returncode == 2
    assert (tmp_path / "in.json").read_bytes() == WITH_NORMALS["plain.xyz"]


def interrupted(script: list[str], phase: str = "meshing", number: signal.Signals = signal.SIGINT) -> tuple[int, str]:
    """Run a command, send it a signal, that of Ctrl-C, once it says a phase; return exit code and errors.

    It fails if the command has not ended 10 seconds later: one that waits out its work takes a minute.
    """
    process = subprocess.Popen(script, stderr=subprocess.PIPE, env={**os.environ, "PYTHONUNBUFFERED": "1"})
    assert process.stderr is not None
    told = b""
    while not told.endswith(f"{phase} ...".encode()):
        byte = process.stderr.read(1)
        assert byte, told.decode()
        told += byte
    time.sleep(0.1)
    process.send_signal(number)
    told += process.communicate(timeout=10)[1]
    return process.returncode, told.decode()


@pytest.fixture
def sleeping(tmp_path: Path) -> list[str]:
    (tmp_path / "scan.ply").write_bytes(WITH_NORMALS["binary.ply"])
    return stand_in("reconstruct", tmp_path / "scan.ply", tmp_path / "mesh.obj", "--seed", str(standins.SLEEPING_SEED))


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGHUP])
def test_a_run_that_is_terminated_leaves_nothing(number: signal.Signals, sleeping: list[str], tmp_path: Path) -> None:
    exit_code, told = interrupted(sleeping, number=number)
    assert exit_code == 143
    assert "Error: Terminated" in told
    assert "Traceback" not in told
    assert [each.name for each in tmp_path.iterdir()] == ["scan.ply"]


def test_ctrl_c_ends_at_once_and_leaves_nothing(sleeping: list[str], tmp_path: Path) -> None:
    exit_code, told = interrupted(sleeping)
    assert exit_code == 130
    assert "Error: Interrupted" in told
    assert "Traceback" not in told
    assert [each.name for each in tmp_path.iterdir()] == ["scan.ply"]


@pytest.mark.slow
@pytest.mark.parametrize("phase", ["embedding", "particles"])
def test_ctrl_c_ends_a_real_run_wherever_it_is(phase: str, tmp_path: Path) -> None:
    np.save(tmp_path / "scan.npy", clouds.sphere(40_000)[0])
    (tmp_path / "mesh.obj").write_text("# made by hdpea: mesh")
    script = command("reconstruct", tmp_path / "scan.npy", tmp_path / "mesh.obj", "--report", tmp_path / "told.json")
    exit_code, told = interrupted(script, phase)
    assert exit_code == 130
    assert "Error: Interrupted" in told
    assert "Traceback" not in told
    assert {each.name for each in tmp_path.iterdir()} == {"scan.npy", "mesh.obj"}
    assert (tmp_path / "mesh.obj").read_text() == "# made by hdpea: mesh"


@pytest.mark.parametrize(("number", "code"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_signals_end_compiled_code_that_never_looks_up(number: signal.Signals, code: int, tmp_path: Path) -> None:
    # Like a long call of the core: Python's own handling of Ctrl-C has no chance to run.
    script = f"""
import hashlib, sys
from hdpea.runtime.interrupts import prompt_interrupts
from hdpea.runtime.outputs import replacing
from pathlib import Path
with prompt_interrupts(), replacing(Path({str(tmp_path / "mesh.obj")!r})) as partial:
    partial.write_text("half")
    sys.stderr.write("meshing ...")
    hashlib.pbkdf2_hmac("sha256", b"", b"", 10**9)
"""
    exit_code, told = interrupted([sys.executable, "-c", script], number=number)
    assert exit_code == code
    assert ("Error: Interrupted" if code == 130 else "Error: Terminated") in told
    assert list(tmp_path.iterdir()) == []
