// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/cloud/ply_writer.hpp"

#include <bit>
#include <cstdint>
#include <string>

#include "common/files/text_file.hpp"

namespace adit {
namespace {

void append(std::string& text, float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  for (unsigned shift = 0; shift < 32; shift += 8) text += static_cast<char>(bits >> shift & 0xffU);
}

}  // namespace

void write_ply(const Cloud& cloud, const std::filesystem::path& file) {
  std::string text = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                     std::to_string(cloud.points()) +
                     "\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
  for (const CloudLine& line : cloud.lines) {
    for (const Eigen::Vector3f& p : line.points) {
      for (const float value : p) append(text, value);
    }
  }
  write_text(text, file);
}

}  // namespace adit
