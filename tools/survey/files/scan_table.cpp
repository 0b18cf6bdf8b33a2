// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/files/scan_table.hpp"

#include <memory>

#include <cpl_conv.h>
#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>
#include <ogrsf_frmts.h>

#include "common/files/file_error.hpp"
#include "common/text/message_text.hpp"
#include "tools/survey/files/gdal_support.hpp"

namespace adit {
namespace {

[[noreturn]] void fail_table(const std::filesystem::path& path, const std::string& reason) {
  throw FileError(message_line(fmt::format("{}: {}", path.string(), reason)));
}

std::string wkt2_of(const OGRSpatialReference& crs) {
  constexpr const char* kOptions[] = {"FORMAT=WKT2_2019", nullptr};
  char* text = nullptr;
  crs.exportToWkt(&text, kOptions);
  std::string wkt = text == nullptr ? "" : text;
  CPLFree(text);
  return wkt;
}

}  // namespace

ScanTable read_scan_table(const std::filesystem::path& path) {
  prepare_gdal();
  CPLErrorReset();
  constexpr unsigned int kRead = GDAL_OF_VECTOR | GDAL_OF_READONLY;
  const std::unique_ptr<GDALDataset, CloseDataset> file(
      GDALDataset::Open(path.c_str(), kRead, nullptr, nullptr, nullptr));
  if (!file) fail_table(path, "no such GeoPackage, or damaged");
  OGRLayer* const layer = file->GetLayerByName("scans");
  if (layer == nullptr || layer->GetSpatialRef() == nullptr)
    fail_table(path, "no layer scans with a coordinate system: not a survey of adit survey");
  const auto field = [&](const char* name) {
    const int at = layer->GetLayerDefn()->GetFieldIndex(name);
    if (at < 0)
      fail_table(path, fmt::format("its scans have no {}: survey the mission again", name));
    return at;
  };
  const int number = field("scan");
  const int laser = field("laser_m");
  const int step = field("step_sd_m");
  const int step_turn = field("step_turn_sd_rad");
  const int step_z = field("step_z_sd_m");
  ScanTable table;
  table.crs_wkt = wkt2_of(*layer->GetSpatialRef());
  const char* const name = layer->GetSpatialRef()->GetName();
  table.crs_name = name == nullptr ? "unnamed" : name;
  for (const auto& feature : *layer) {
    const OGRGeometry* const geometry = feature->GetGeometryRef();
    if (geometry == nullptr || wkbFlatten(geometry->getGeometryType()) != wkbPoint)
      fail_table(path, "a scan without a place");
    const OGRPoint& place = *geometry->toPoint();
    table.scans.push_back({feature->GetFieldAsInteger64(number),
                           {place.getX(), place.getY(), feature->GetFieldAsDouble(laser)},
                           feature->GetFieldAsDouble(step),
                           feature->GetFieldAsDouble(step_turn),
                           feature->GetFieldAsDouble(step_z)});
  }
  return table;
}

}  // namespace adit
