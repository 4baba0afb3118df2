#!/bin/sh
# Makes the pictures of README.md with the program itself.
set -eu
cd "$(dirname "$0")/.."
for degree in 1 3; do
  build/release/apps/majorant parametrize meshes/creature.obj --degree $degree --quiet \
    -o docs/creature_degree_$degree.svg
done
