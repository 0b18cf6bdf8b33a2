#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# open_by_others.sh SURVEY: opens the files of a survey by other programs: LAS, DXF and the mesh, which it checks for holes and
# triangles that cross, by packages of npm, which it installs in a temporary folder, the rest by GDAL's and poppler's commands.
set -euo pipefail
here=$(dirname "$(readlink -f "$0")")
survey=$(realpath "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cp "$here/read_survey.mjs" "$here/read_mesh.mjs" "$work"
(cd "$work" && npm install --loglevel=error --no-fund --no-audit copc@0.0.8 dxf-parser@1 three@0.160 three-mesh-bvh@0.7 >/dev/null)
node "$work/read_survey.mjs" "$survey"
node "$work/read_mesh.mjs" "$survey/void.ply"
for layer in $(ogrinfo -q "$survey/survey.gpkg" | sed 's/^[0-9]*: \([a-z_]*\).*/\1/'); do
  echo "survey.gpkg: $layer, $(ogrinfo -so "$survey/survey.gpkg" "$layer" | grep 'Feature Count')"
done
for raster in floor roof height deviation occupancy; do
  echo "$raster.tif: $(gdalinfo -stats "$survey/$raster.tif" | grep -m1 'Minimum')"
  rm -f "$survey/$raster.tif.aux.xml"
done
pdfinfo "$survey/plan.pdf" | grep 'Page size'
