// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/sim/scan_file.hpp"

#include <stdexcept>

#include "common/bus/channels.hpp"
#include "common/bus/log/lcm_log.hpp"
#include "common/messages/codec.hpp"
#include "common/messages/mapping/cloud.hpp"
#include "tools/cloud/cloud_file.hpp"

namespace adit {
namespace {

void write_log(const Cloud& cloud, const std::filesystem::path& file) {
  LogWriter log(file);
  for (const CloudFragment& fragment : split(cloud)) {
    log.write({cloud.utime, channels::kCloud, encode(to_message(fragment))});
  }
  log.close();
}

}  // namespace

void write_scan(const Cloud& cloud, const std::filesystem::path& file) {
  if (file.extension() == ".lcmlog") return write_log(cloud, file);
  if (file.extension() == ".ply") return write_ply(cloud, file);
  throw std::runtime_error(file.string() + ": the file of a 3D scan must end in .lcmlog or .ply");
}

}  // namespace adit
