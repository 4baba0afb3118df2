#!/bin/sh
# Makes the pictures of README.md and docs/ with the program itself. Those of deformations and charts
# need the meshes of ../shared.
set -eu
cd "$(dirname "$0")/.."
majorant=build/release/apps/majorant
mkdir -p docs/pictures
for degree in 1 3; do
  $majorant parametrize meshes/creature.obj --degree $degree --quiet \
    -o docs/creature_degree_$degree.svg
done
$majorant parametrize meshes/creature.obj --degree 3 --quiet --size 640,560 --view 1,0.5,2 \
  -o docs/pictures/creature_checkered.png
meshes=../shared/data/public/deform2d
[ -d "$meshes" ] || exit 0
for name in bar star gingerbread; do
  $majorant deform $meshes/$name.obj --handles $meshes/$name.json --bijective --degree 2 --quiet \
    -o docs/pictures/$name.svg
done
$majorant deform $meshes/gingerbread.obj --handles $meshes/gingerbread.json --degree 2 --quiet \
  -o docs/pictures/gingerbread_overlap.svg
$majorant unwrap ../shared/data/public/closed/spot_1654.obj --quiet --size 480,480 \
  --view=-0.56,0.21,-0.8 -o docs/pictures/spot_layout.svg -o docs/pictures/spot_checkered.png
