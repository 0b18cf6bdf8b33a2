// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/cloud/cloud_file.hpp"

#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <string>
#include <string_view>

#include "common/files/mapped_file.hpp"
#include "tools/cloud/pcd_reader.hpp"
#include "tools/cloud/ply_file.hpp"
#include "tools/cloud/xyz_reader.hpp"

namespace adit {
namespace {

bool begins_with(std::span<const std::uint8_t> bytes, std::string_view text) {
  return bytes.size() >= text.size() && std::equal(text.begin(), text.end(), bytes.begin());
}

std::string ending(const std::filesystem::path& file) {
  std::string text = file.extension().string();
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

PointCloud read(std::span<const std::uint8_t> bytes, const std::string& ending) {
  if (bytes.empty()) throw std::runtime_error("is empty");
  if (ending == ".ply" || begins_with(bytes, "ply\n") || begins_with(bytes, "ply\r")) {
    return read_ply(bytes);
  }
  if (ending == ".pcd" || begins_with(bytes, "# .PCD")) return read_pcd(bytes);
  for (const char* text : {".xyz", ".txt", ".csv", ".asc"}) {
    if (ending == text) return read_xyz(bytes);
  }
  throw std::runtime_error("is no point cloud that is known: PLY, PCD or XYZ");
}

}  // namespace

PointCloud read_cloud_file(const std::filesystem::path& file) {
  const MappedFile mapped(file);
  try {
    PointCloud cloud = read(mapped.bytes(), ending(file));
    if (!cloud.points.empty()) return cloud;
    throw std::runtime_error(
        cloud.skipped == 0
            ? "has no points"
            : "has no usable point: all are infinite, or farther than 100 km from 0");
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
}

}  // namespace adit
