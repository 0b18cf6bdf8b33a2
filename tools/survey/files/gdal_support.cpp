// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/files/gdal_support.hpp"

#include <stdexcept>

#include <cpl_conv.h>
#include <cpl_error.h>
#include <fmt/format.h>
#include <gdal.h>
#include <ogr_spatialref.h>

#include "common/files/file_error.hpp"
#include "common/text/message_text.hpp"

namespace adit {

void CloseDataset::operator()(GDALDataset* dataset) const { GDALClose(dataset); }

void prepare_gdal() {
  GDALAllRegister();
  CPLSetErrorHandler(CPLQuietErrorHandler);
}

std::string wkt1_of(const std::string& crs_wkt) {
  OGRSpatialReference crs;
  char* text = nullptr;
  if (crs.importFromWkt(crs_wkt.c_str()) != OGRERR_NONE || crs.exportToWkt(&text) != OGRERR_NONE) {
    CPLFree(text);
    throw std::runtime_error("the coordinate system cannot be written as WKT 1");
  }
  std::string wkt1 = text;
  CPLFree(text);
  return wkt1;
}

void fail_gdal(const std::filesystem::path& path) {
  const std::string reason = CPLGetLastErrorMsg();
  throw FileError(message_line(fmt::format("cannot write {}: {}", path.string(),
                                           reason.empty() ? "GDAL gives no reason" : reason)));
}

}  // namespace adit
