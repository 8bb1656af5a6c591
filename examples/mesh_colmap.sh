#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Meshes the fused cloud of every COLMAP project below a folder; for cron.
#
#     examples/mesh_colmap.sh projects/ [options of hdpea reconstruct]
#
# Beside each dense/fused.ply: mesh.ply with its colours, and mesh.json with what was measured. What is newer than its
# cloud is left alone. Ends with 1 if any project has no mesh.
set -u
projects=$1
shift
failed=0
for cloud in "$projects"/*/dense/fused.ply; do
  mesh=${cloud%fused.ply}mesh.ply
  [ "$mesh" -nt "$cloud" ] && continue
  hdpea reconstruct "$cloud" "$mesh" --report "${mesh%.ply}.json" --quiet "$@"
  case $? in
    0) echo "$mesh" ;;
    5) echo "$mesh: look at it, the report says what was missed" ;;
    130 | 143) exit 1 ;;
    *) failed=1 ;;
  esac
done
exit $failed
