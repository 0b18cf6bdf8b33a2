// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/types/cloud.hpp"

namespace adit {

/// Points of a file, in the frame of the file [m].
struct PointCloud {
  static constexpr std::size_t kPointsMax = 20'000'000;
  static constexpr double kCoordinateMaxM = 1e5;

  std::vector<Eigen::Vector3d> points;
  std::size_t skipped = 0;                ///< points that are not finite or beyond kCoordinateMaxM
  std::optional<Eigen::Vector3d> sensor;  ///< viewpoint, if the file specifies one

  /// Appends a valid point, else counts it in `skipped`.
  void add(const Eigen::Vector3d& p);
  /// Reserves memory. Throws std::runtime_error if `count` exceeds kPointsMax.
  void reserve(std::size_t count);
};

/// Reads a PLY, PCD or XYZ file, identified by its first bytes or its extension. Throws
/// std::runtime_error with file and line or byte if the file is missing, empty, malformed or of
/// another format, or has no valid point.
PointCloud read_cloud_file(const std::filesystem::path& file);

// Readers of the formats. They allocate no more memory than the input justifies, and throw
// std::runtime_error, one line with the line number or byte offset, for malformed input.

/// Reads the vertices of a PLY file (ascii, binary little or big endian): x, y and z of any numeric
/// type. Other properties and elements are ignored.
PointCloud read_ply(std::span<const std::uint8_t> bytes);

/// Reads a PCD file (ascii, binary, binary_compressed): fields x, y and z of any numeric type, and
/// the position in VIEWPOINT. Other fields are ignored.
PointCloud read_pcd(std::span<const std::uint8_t> bytes);

/// Reads one point per line: x, y and z separated by blanks, commas or semicolons; further columns
/// are ignored. Lines that begin with # or // are comments; the first line may name the columns.
PointCloud read_xyz(std::span<const std::uint8_t> bytes);

/// Writes the points of a cloud, in level, as binary PLY (little endian, float). Line structure,
/// laser positions and beams without return are not written. Throws std::runtime_error if the file
/// cannot be written.
void write_ply(const Cloud& cloud, const std::filesystem::path& file);

}  // namespace adit
