// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include <fmt/format.h>

namespace adit {

/// The engineering coordinate reference system (ISO 19162, WKT 2) of x and y in metres in a frame
/// that is not tied to the earth. As the name in the member `crs` of GeoJSON (2008) it keeps GDAL
/// and QGIS from reading metres as longitude and latitude; readers of RFC 7946 ignore that member.
inline std::string local_crs_wkt(std::string_view frame, std::string_view datum) {
  return fmt::format(
      R"(ENGCRS["{}",EDATUM["{}"],CS[Cartesian,2],AXIS["x",unspecified],AXIS["y",unspecified],)"
      R"(LENGTHUNIT["metre",1]])",
      frame, datum);
}

}  // namespace adit
