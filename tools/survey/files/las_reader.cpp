// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/files/las_reader.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "common/files/file_error.hpp"
#include "common/files/mapped_file.hpp"

namespace adit {
namespace {

// Offsets: LAS specification 1.4 - R15, tables 3 and 12.
constexpr std::size_t kVersionAt = 24;
constexpr std::size_t kPointsAt = 96;
constexpr std::size_t kFormatAt = 104;
constexpr std::size_t kPointBytesAt = 105;
constexpr std::size_t kScaleAt = 131;
constexpr std::size_t kOffsetAt = 155;
constexpr std::size_t kCountAt = 247;
constexpr std::size_t kHeaderBytesMin = 375;
constexpr std::size_t kFormat6Bytes = 30;
constexpr std::size_t kOwnPointBytes = kFormat6Bytes + 12;
constexpr std::size_t kReleaseEveryPoints = 1 << 20;

template <class T>
T number_at(std::span<const std::uint8_t> bytes, std::size_t offset) {
  T value{};
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

Eigen::Vector3d vector_at(std::span<const std::uint8_t> bytes, std::size_t offset) {
  return {number_at<double>(bytes, offset), number_at<double>(bytes, offset + 8),
          number_at<double>(bytes, offset + 16)};
}

[[noreturn]] void fail(const std::filesystem::path& path, std::string_view reason) {
  throw FileError(fmt::format("{}: {}", path.string(), reason));
}

/// Whether the records before the points describe the attributes that `write_las` writes.
bool has_own_attributes(std::span<const std::uint8_t> records) {
  const std::string_view text(reinterpret_cast<const char*>(records.data()), records.size());
  const std::size_t plan = text.find("sd_plan");
  return text.find("LASF_Spec") != std::string_view::npos && plan != std::string_view::npos &&
         text.find("sd_z", plan) != std::string_view::npos;
}

}  // namespace

void read_las(const std::filesystem::path& path,
              const std::function<void(const LasPoint&)>& visit) {
  const MappedFile file(path);
  const auto bytes = file.bytes();
  if (bytes.size() < kHeaderBytesMin || std::memcmp(bytes.data(), "LASF", 4) != 0)
    fail(path, "not a LAS file");
  const auto first = number_at<std::uint32_t>(bytes, kPointsAt);
  const auto count = number_at<std::uint64_t>(bytes, kCountAt);
  const Eigen::Vector3d scale = vector_at(bytes, kScaleAt);
  const Eigen::Vector3d offset = vector_at(bytes, kOffsetAt);
  if (bytes[kVersionAt] != 1 || bytes[kVersionAt + 1] != 4 || bytes[kFormatAt] != 6 ||
      number_at<std::uint16_t>(bytes, kPointBytesAt) != kOwnPointBytes || first < kHeaderBytesMin ||
      first > bytes.size() || !has_own_attributes(bytes.first(first)))
    fail(path, "not a cloud of adit survey (LAS 1.4 with scan, sd_plan and sd_z)");
  if (count > (bytes.size() - first) / kOwnPointBytes) fail(path, "truncated");
  if (!scale.allFinite() || !offset.allFinite()) fail(path, "damaged header");
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::size_t begin = first + i * kOwnPointBytes;
    const auto record = bytes.subspan(begin, kOwnPointBytes);
    LasPoint point;
    for (int axis = 0; axis < 3; ++axis) {
      const auto at = static_cast<std::size_t>(axis);
      point.p[axis] = offset[axis] + scale[axis] * number_at<std::int32_t>(record, 4 * at);
    }
    point.scan = number_at<std::uint32_t>(record, kFormat6Bytes);
    point.plan_sd_m = number_at<float>(record, kFormat6Bytes + 4);
    point.z_sd_m = number_at<float>(record, kFormat6Bytes + 8);
    if (!(point.plan_sd_m >= 0.0F && point.z_sd_m >= 0.0F && std::isfinite(point.plan_sd_m) &&
          std::isfinite(point.z_sd_m)))
      fail(path, fmt::format("point {} has no standard deviation", i + 1));
    visit(point);  // until the end it is not known whether the disk can read the file
    if (i % kReleaseEveryPoints == 0) file.release(first, begin);
  }
  file.require_readable();
}

}  // namespace adit
