# SPDX-License-Identifier: GPL-3.0-or-later
"""GLB files taken apart, and what the validator of Khronos says of them."""

from __future__ import annotations

import json
import shutil
import struct
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

_TYPES = {5126: "<f4", 5123: "<u2", 5125: "<u4"}

_VALIDATOR = """
const validator = require("gltf-validator");
const data = new Uint8Array(require("fs").readFileSync(process.argv[1]));
validator.validateBytes(data).then(report => console.log(JSON.stringify(report.issues)));
"""


def parts_of(path: Path) -> tuple[dict[str, Any], dict[str, NDArray[Any]]]:
    """Return what a GLB file says, and its arrays by name."""
    data = path.read_bytes()
    (length,) = struct.unpack_from("<I", data, 12)
    tree, body = json.loads(data[20 : 20 + length]), data[28 + length :]
    primitive = tree["meshes"][0]["primitives"][0]
    arrays = {}
    for name, accessor in {**primitive["attributes"], "indices": primitive["indices"]}.items():
        found = tree["accessors"][accessor]
        view = tree["bufferViews"][found["bufferView"]]
        dtype = _TYPES[found["componentType"]]
        values = np.frombuffer(body[view["byteOffset"] : view["byteOffset"] + view["byteLength"]], dtype)
        arrays[name] = values.reshape(found["count"], -1)
    return tree, arrays


def require_validator() -> None:
    """Skip a test where there is no node, or no gltf-validator for it."""
    node = shutil.which("node")
    command = [node or "", "-e", "require('gltf-validator')"]
    if node is None or subprocess.run(command, capture_output=True, check=False).returncode != 0:
        pytest.skip("needs node and `npm install gltf-validator` (NODE_PATH says where)")


def validator_messages(path: Path) -> list[Any]:
    """Return the errors, warnings and hints of the validator; none is what one wants."""
    command = [str(shutil.which("node")), "-e", _VALIDATOR, str(path)]
    printed = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    messages: list[Any] = json.loads(printed)["messages"]
    return messages
