// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

class GDALDataset;

namespace adit {

/// Closes a file of GDAL, for std::unique_ptr.
struct CloseDataset {
  void operator()(GDALDataset* dataset) const;
};

/// Makes the drivers of GDAL known. It prints no messages from then on: what fails is reported by
/// `fail_gdal`. Any number of calls.
void prepare_gdal();

/// A coordinate system of WKT 2 in WKT 1, for formats that are older. Throws std::runtime_error for
/// a text that is none.
std::string wkt1_of(const std::string& crs_wkt);

/// Throws FileError with the path and the last message of GDAL.
[[noreturn]] void fail_gdal(const std::filesystem::path& path);

}  // namespace adit
