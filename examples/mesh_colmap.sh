#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Meshes the fused cloud of every COLMAP project that has none yet, or a newer cloud; for cron.
#
#     mesh_colmap.sh PROJECTS MESHES [options of hdpea reconstruct]
#
# Of PROJECTS/NAME/dense/fused.ply it makes MESHES/NAME-DATE.ply with its colours, and NAME-DATE.json with what was
# measured; those of other days stay. What is not as it was asked for is called .bad.ply and .bad.json, and is tried
# again the next time. Ends with 1 if there is any such, or any project without a cloud or a mesh; with 2 if there is no
# project.
set -u
[ $# -ge 2 ] || { echo "usage: $0 PROJECTS MESHES [options of hdpea reconstruct]" >&2; exit 2; }
projects=$1 meshes=$2 failed=0
shift 2
command -v hdpea >/dev/null || { echo "There is no hdpea on the PATH: PATH=VENV/bin:\$PATH $0 ..." >&2; exit 2; }
mkdir -p "$meshes" || exit 2
for project in "$projects"/*/; do
  [ -e "$project" ] || { echo "There is no project in $projects." >&2; exit 2; }
  name=$(basename "$project") cloud=${project}dense/fused.ply
  [ -e "$cloud" ] || { echo "There is no cloud $cloud." >&2; failed=1; continue; }
  mesh=$meshes/$name-$(date +%F)
  [ -n "$(find "$meshes" -name "$name-????-??-??.ply" -newer "$cloud")" ] && continue
  hdpea reconstruct "$cloud" "$mesh.bad.ply" --report "$mesh.bad.json" --quiet "$@"
  case $? in
    0) mv "$mesh.bad.json" "$mesh.json" && mv "$mesh.bad.ply" "$mesh.ply" && echo "$mesh.ply" ;;
    130 | 143) exit 1 ;;
    *) failed=1 ;;
  esac
done
exit $failed
