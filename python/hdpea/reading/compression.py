# SPDX-License-Identifier: GPL-3.0-or-later
"""Files that are compressed as a whole."""

from __future__ import annotations

import zlib

from hdpea.errors import UnreadableInput
from hdpea.reading.arrays import ALWAYS_UNPACKED, MOST_UNPACKED

GZIP = b"\x1f\x8b"


def unzipped(data: bytes) -> bytes:
    """Return what a gzip file holds, in all its members.

    Raises
    ------
    UnreadableInput
        If it is damaged, or would unpack to far more than points can be compressed from.
    """
    most = max(MOST_UNPACKED * len(data), ALWAYS_UNPACKED)
    parts, room, rest = [], most, data
    try:
        while rest.startswith(GZIP):
            member = zlib.decompressobj(wbits=zlib.MAX_WBITS | 16)
            parts.append(member.decompress(rest, room + 1))
            room -= len(parts[-1])
            if room < 0:
                raise UnreadableInput(f"its {len(data):,} bytes unpack to more than {most:,}.", "Unpack it: gunzip IN")
            if not member.eof:
                raise UnreadableInput(
                    "its compressed content ends early.", "It may have been cut off while being copied."
                )
            rest = member.unused_data
    except zlib.error as error:
        raise UnreadableInput(
            f"it is damaged gzip ({error}).", "It may have been cut off while being copied."
        ) from error
    return b"".join(parts)
