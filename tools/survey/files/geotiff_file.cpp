// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/files/geotiff_file.hpp"

#include <array>
#include <limits>
#include <memory>

#include <cpl_string.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include "tools/survey/files/gdal_support.hpp"

namespace adit {
namespace {

struct FreeOptions {
  void operator()(char** options) const { CSLDestroy(options); }
};

bool write_band(const RasterBand& values, const Raster& raster, GDALRasterBand& band) {
  band.SetDescription(values.description.c_str());
  band.SetUnitType(values.unit.c_str());
  band.SetNoDataValue(std::numeric_limits<double>::quiet_NaN());
  return band.RasterIO(GF_Write, 0, 0, raster.columns, raster.rows,
                       const_cast<float*>(values.values.data()),  // GDAL's interface; it reads only
                       raster.columns, raster.rows, GDT_Float32, 0, 0) == CE_None;
}

}  // namespace

void write_geotiff(const Raster& raster, const std::string& crs_wkt,
                   const std::filesystem::path& path) {
  prepare_gdal();
  CPLErrorReset();
  char** list = nullptr;
  for (const char* option : {"COMPRESS=DEFLATE", "PREDICTOR=3", "TILED=YES", "BIGTIFF=IF_SAFER"})
    list = CSLAddString(list, option);
  const std::unique_ptr<char*, FreeOptions> options(list);
  GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  if (driver == nullptr) fail_gdal(path);
  std::unique_ptr<GDALDataset, CloseDataset> file(
      driver->Create(path.c_str(), raster.columns, raster.rows,
                     static_cast<int>(raster.bands.size()), GDT_Float32, options.get()));
  if (!file) fail_gdal(path);
  std::array<double, 6> to_world{raster.north_west.x(), raster.cell_m, 0.0,
                                 raster.north_west.y(), 0.0,           -raster.cell_m};
  OGRSpatialReference crs;
  if (file->SetGeoTransform(to_world.data()) != CE_None ||
      crs.importFromWkt(crs_wkt.c_str()) != OGRERR_NONE || file->SetSpatialRef(&crs) != CE_None)
    fail_gdal(path);
  for (std::size_t i = 0; i < raster.bands.size(); ++i) {
    if (!write_band(raster.bands[i], raster, *file->GetRasterBand(static_cast<int>(i) + 1)))
      fail_gdal(path);
  }
  file->FlushCache(true);
  if (CPLGetLastErrorType() >= CE_Failure) fail_gdal(path);
}

}  // namespace adit
