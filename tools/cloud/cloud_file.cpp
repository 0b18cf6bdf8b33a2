// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/cloud/cloud_file.hpp"

#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "common/config/number_text.hpp"
#include "common/files/mapped_file.hpp"
#include "tools/cloud/text_lines.hpp"

namespace adit {

void PointCloud::add(const Eigen::Vector3d& p) {
  const bool valid = p.allFinite() && p.cwiseAbs().maxCoeff() <= kCoordinateMaxM;
  if (!valid) {
    ++skipped;
    return;
  }
  if (points.size() == kPointsMax) reserve(kPointsMax + 1);
  points.push_back(p);
}

void PointCloud::reserve(std::size_t count) {
  if (count > kPointsMax) {
    throw std::runtime_error(
        fmt::format("more than {} million points; downsample the cloud", kPointsMax / 1'000'000));
  }
  points.reserve(count);
}

namespace {

bool begins_with(std::span<const std::uint8_t> bytes, std::string_view text) {
  return bytes.size() >= text.size() && std::equal(text.begin(), text.end(), bytes.begin());
}

std::string lower_case_extension(const std::filesystem::path& file) {
  std::string text = file.extension().string();
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

PointCloud read(std::span<const std::uint8_t> bytes, const std::string& extension) {
  if (bytes.empty()) throw std::runtime_error("file is empty");
  if (extension == ".ply" || begins_with(bytes, "ply\n") || begins_with(bytes, "ply\r")) {
    return read_ply(bytes);
  }
  if (extension == ".pcd" || begins_with(bytes, "# .PCD")) return read_pcd(bytes);
  for (const char* text : {".xyz", ".txt", ".csv", ".asc"}) {
    if (extension == text) return read_xyz(bytes);
  }
  throw std::runtime_error("unknown point cloud format; supported are PLY, PCD and XYZ");
}

}  // namespace

PointCloud read_cloud_file(const std::filesystem::path& file) {
  const MappedFile mapped(file);
  try {
    PointCloud cloud = read(mapped.bytes(), lower_case_extension(file));
    mapped.require_readable();
    if (!cloud.points.empty()) return cloud;
    throw std::runtime_error(
        cloud.skipped == 0
            ? "file has no points"
            : "no valid point: all are not finite or farther than 100 km from the origin");
  } catch (const std::runtime_error& error) {
    mapped.require_readable();
    throw std::runtime_error(fmt::format("{}: {}", file.string(), error.what()));
  }
}

namespace {

std::optional<Eigen::Vector3d> parse_point(std::string_view tokens) {
  Eigen::Vector3d p;
  for (int axis = 0; axis < 3; ++axis) {
    const auto value = parse_number<double>(take_token(tokens));
    if (!value) return std::nullopt;
    p[axis] = *value;
  }
  return p;
}

bool names_columns(std::string_view tokens) {
  const std::string_view first = take_token(tokens);
  return (first[0] == 'x' || first[0] == 'X') &&
         std::all_of(tokens.begin(), tokens.end(), [](char c) {
           return std::isprint(static_cast<unsigned char>(c)) != 0 || c == '\t';
         });
}

}  // namespace

PointCloud read_xyz(std::span<const std::uint8_t> bytes) {
  TextLines lines(bytes);
  PointCloud cloud;
  bool first = true;
  while (const auto line = lines.next_nonblank()) {
    std::string_view tokens = *line;
    const std::string_view token = take_token(tokens);
    if (token.starts_with('#') || token.starts_with("//")) continue;
    if (const auto p = parse_point(*line)) {
      cloud.add(*p);
    } else if (!first || !names_columns(*line)) {
      lines.fail("expected three numbers");
    }
    first = false;
  }
  return cloud;
}

}  // namespace adit
