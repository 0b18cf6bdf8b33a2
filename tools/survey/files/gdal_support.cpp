// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/files/gdal_support.hpp"

#include <cpl_error.h>
#include <fmt/format.h>
#include <gdal.h>

#include "common/files/file_error.hpp"
#include "common/text/message_text.hpp"

namespace adit {

void prepare_gdal() {
  GDALAllRegister();
  CPLSetErrorHandler(CPLQuietErrorHandler);
}

void fail_gdal(const std::filesystem::path& path) {
  const std::string reason = CPLGetLastErrorMsg();
  throw FileError(message_line(fmt::format("cannot write {}: {}", path.string(),
                                           reason.empty() ? "GDAL gives no reason" : reason)));
}

}  // namespace adit
