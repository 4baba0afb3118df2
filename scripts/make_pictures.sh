#!/bin/sh
# Makes the pictures of README.md and docs/, and docs/creature.html, with the program itself
# (MAJORANT_BINARY, or that of the build). Those of the last part need the meshes of ../shared
# (MAJORANT_SHARED_DIR). Margins of PNG are cut off, which needs python3-pil.
set -eu
cd "$(dirname "$0")/.."
majorant=${MAJORANT_BINARY:-build/release/apps/majorant}
public=${MAJORANT_SHARED_DIR:-../shared}/data/public
out=docs/pictures
mkdir -p $out

trim() {
  /usr/bin/python3 - "$@" <<'END'
import sys
from PIL import Image, ImageChops, ImageOps
MARGIN = 12  # pixels
for name in sys.argv[1:]:
    image = Image.open(name).convert('RGB')
    shown = ImageChops.difference(image, Image.new('RGB', image.size, 'white')).getbbox()
    ImageOps.expand(image.crop(shown), MARGIN, 'white').save(name, optimize=True)
END
}

for degree in 1 3; do
  $majorant parametrize meshes/creature.obj --degree $degree --quiet \
    -o docs/creature_degree_$degree.svg
done
$majorant parametrize meshes/creature.obj --degree 3 --quiet --snapshots 16 -o docs/creature.html
$majorant parametrize meshes/creature.obj --degree 3 --quiet --size 900,900 --view 1,0.5,2 \
  -o $out/creature_checkered.png
$majorant parametrize meshes/cap.obj --degree 3 --energy mips --quiet --size 900,900 \
  --view 0.6,1,0.6 -o $out/cap_conformal.png
$majorant seamless meshes/buckle.obj --degree 3 --quiet --size 900,900 --view 0.5,0.7,2 \
  -o $out/buckle_seamless.png
trim $out/creature_checkered.png $out/cap_conformal.png $out/buckle_seamless.png

[ -d "$public" ] || exit 0
$majorant parametrize $public/disks/helix_500.obj --bijective --degree 3 --quiet -o $out/helix.svg
for name in bar star gingerbread; do
  $majorant deform $public/deform2d/$name.obj --handles $public/deform2d/$name.json --bijective \
    --degree 2 --quiet -o $out/$name.svg
done
$majorant deform $public/deform2d/gingerbread.obj --handles $public/deform2d/gingerbread.json \
  --degree 2 --quiet -o $out/gingerbread_overlap.svg
$majorant unwrap $public/closed/spot_1654.obj --quiet --size 900,900 --view=-0.56,0.21,-0.8 \
  -o $out/spot_layout.svg -o $out/spot_checkered.png
trim $out/spot_checkered.png
