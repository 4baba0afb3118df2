#!/bin/sh
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause

# Makes the pictures of README.md and docs/, and docs/creature.html, with the program
# (MAJORANT_BINARY, or that of the build). The last ones need the meshes of ../shared
# (MAJORANT_SHARED_DIR).
set -eu
cd "$(dirname "$0")/../.."
majorant=${MAJORANT_BINARY:-build/release/apps/majorant}
public=${MAJORANT_SHARED_DIR:-../shared}/data/public
out=docs/pictures
mkdir -p $out

for degree in 1 3; do
  $majorant parametrize examples/meshes/creature.obj --degree $degree --quiet \
    -o docs/creature_degree_$degree.svg
done
$majorant parametrize examples/meshes/creature.obj --degree 3 --quiet --snapshots 16 -o docs/creature.html
$majorant parametrize examples/meshes/creature.obj --degree 3 --quiet --size 900,900 --view 1,0.5,2 \
  -o $out/creature_checkered.png
$majorant parametrize examples/meshes/cap.obj --degree 3 --energy mips --quiet --size 900,900 \
  --view 0.6,1,0.6 -o $out/cap_conformal.png
$majorant seamless examples/meshes/buckle.obj --degree 3 --quiet --size 900,900 --view 0.5,0.7,2 \
  -o $out/buckle_seamless.png
for mesh in buckle creature; do
  $majorant quads examples/meshes/$mesh.obj --count 1500 --quiet -o $out/quads_$mesh.png
done
$majorant parametrize examples/meshes/helix.obj --bijective --degree 3 --quiet -o $out/helix.svg
$majorant deform examples/meshes/bar.obj --handles examples/meshes/bar.json --bijective --degree 2 --quiet \
  -o $out/bar.svg

[ -d "$public" ] || exit 0
$majorant deform $public/deform2d/star.obj --handles $public/deform2d/star.json --bijective \
  --degree 2 --quiet -o $out/star.svg
# The raised hand moves across the head.
handles=$(mktemp)
trap 'rm -f "$handles"' EXIT
sed 's/^ *0\.95,$/0.1,/; s/^ *1\.55$/1.2/' $public/deform2d/gingerbread.json > "$handles"
gingerbread="deform $public/deform2d/gingerbread.obj --handles $handles --degree 2 --quiet"
$majorant $gingerbread --bijective -o $out/gingerbread.svg
$majorant $gingerbread -o $out/gingerbread_overlap.svg
$majorant unwrap $public/closed/spot_1654.obj --quiet --size 900,900 --view \
  -o $out/spot_layout.svg -o $out/spot_checkered.png
