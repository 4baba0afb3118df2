#!/bin/sh
# Makes the pictures of README.md and docs/ with the program itself. Those of deformations and charts
# need the meshes of ../shared.
set -eu
cd "$(dirname "$0")/.."
majorant=build/release/apps/majorant
for degree in 1 3; do
  $majorant parametrize meshes/creature.obj --degree $degree --quiet \
    -o docs/creature_degree_$degree.svg
done
meshes=../shared/data/public/deform2d
[ -d "$meshes" ] || exit 0
mkdir -p docs/pictures
for name in bar star gingerbread; do
  $majorant deform $meshes/$name.obj --handles $meshes/$name.json --bijective --degree 2 --quiet \
    -o docs/pictures/$name.svg
done
$majorant deform $meshes/gingerbread.obj --handles $meshes/gingerbread.json --degree 2 --quiet \
  -o docs/pictures/gingerbread_overlap.svg
layout=$(mktemp --suffix .obj)
trap 'rm -f "$layout"' EXIT
$majorant unwrap ../shared/data/public/closed/spot_1654.obj --quiet --force -o "$layout" \
  -o docs/pictures/spot_layout.svg
/usr/bin/python3 scripts/checkered.py "$layout" docs/pictures/spot_checkered.png --turn 215 --tilt 12
