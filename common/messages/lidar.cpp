// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/lidar.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string_view>
#include <utility>

#include "common/messages/fields/sensing_fields.hpp"

namespace adit {
namespace {

constexpr std::int16_t kNoReturn = 0;
constexpr std::int16_t kNotMeasured = -1;

std::int16_t encoded_range(float range_m) {
  if (std::isnan(range_m) || range_m < 0.0F) return kNotMeasured;
  const float units = std::round(range_m / kLidarRangeUnitM);
  if (units > static_cast<float>(std::numeric_limits<std::int16_t>::max())) return kNoReturn;
  return static_cast<std::int16_t>(std::max(units, 1.0F));
}

float decoded_range_m(std::int16_t range, float unit_m) {
  if (range == kNoReturn) return std::numeric_limits<float>::infinity();
  if (range < 0) return std::numeric_limits<float>::quiet_NaN();
  return static_cast<float>(range) * unit_m;
}

std::string_view shape_rejection_reason(const spinning_lidar_t& message) {
  const auto rings = static_cast<std::size_t>(message.n_rings);
  if (rings == 0 || rings > LidarFragment::kRingsMax) return "implausible number of rings";
  if (static_cast<std::size_t>(message.n_columns) > LidarFragment::kColumnsMax) {
    return "implausible number of columns";
  }
  if (!std::ranges::is_sorted(message.elevations_rad, std::less_equal{})) {
    return "elevations do not increase";
  }
  if (!std::ranges::is_sorted(message.times_us)) return "times of columns do not increase";
  return fragment_rejection_reason(message, LidarFragment::kFragmentsMax);
}

}  // namespace

spinning_lidar_t to_message(const LidarFragment& fragment) {
  const LidarRevolution& part = fragment.part;
  spinning_lidar_t message;
  message.utime = part.utime;
  message.n_rings = static_cast<std::int32_t>(part.rings.size());
  for (const LidarRing& ring : part.rings) {
    message.elevations_rad.push_back(ring.elevation_rad);
    message.ring_azimuths_rad.push_back(ring.azimuth_offset_rad);
    message.ring_times_us.push_back(ring.time_offset_us);
  }
  message.range_unit_m = kLidarRangeUnitM;
  message.n_fragments = fragment.n_fragments;
  message.fragment = fragment.fragment;
  message.n_columns = static_cast<std::int32_t>(part.columns.size());
  for (std::size_t i = 0; i < part.columns.size(); ++i) {
    message.times_us.push_back(part.columns[i].time_us);
    message.azimuths_rad.push_back(part.columns[i].azimuth_rad);
    auto& ranges = message.ranges.emplace_back();
    for (std::size_t j = 0; j < part.rings.size(); ++j) {
      ranges.push_back(encoded_range(part.range_m(i, j)));
    }
  }
  return message;
}

Result<LidarFragment> from_message(const spinning_lidar_t& message) {
  if (const auto reason = implausible_field(message); !reason.empty()) return Rejected{reason};
  if (const auto reason = shape_rejection_reason(message); !reason.empty()) return Rejected{reason};
  LidarRevolution part;
  part.utime = message.utime;
  for (std::size_t j = 0; j < message.elevations_rad.size(); ++j) {
    part.rings.push_back(
        {message.elevations_rad[j], message.ring_azimuths_rad[j], message.ring_times_us[j]});
  }
  for (std::size_t i = 0; i < message.times_us.size(); ++i) {
    part.columns.push_back({message.times_us[i], message.azimuths_rad[i]});
    for (const std::int16_t range : message.ranges[i]) {
      part.ranges_m.push_back(decoded_range_m(range, message.range_unit_m));
    }
  }
  return LidarFragment{std::move(part), message.n_fragments, message.fragment};
}

std::vector<LidarFragment> split(const LidarRevolution& revolution) {
  const std::size_t rings = revolution.rings.size();
  const LidarFragment empty{{revolution.utime, revolution.rings, {}, {}}};
  const auto header_bytes = static_cast<std::size_t>(to_message(empty).getEncodedSize());
  const std::size_t column_bytes = 4 + 4 + 2 * rings;
  const std::size_t columns_max =
      std::max<std::size_t>(1, (kFragmentBytes - header_bytes) / column_bytes);
  std::vector<LidarFragment> fragments;
  for (std::size_t begin = 0; begin == 0 || begin < revolution.columns.size();
       begin += columns_max) {
    const std::size_t end = std::min(begin + columns_max, revolution.columns.size());
    LidarFragment& fragment = fragments.emplace_back(empty);
    const auto column = [&](std::size_t i) {
      return revolution.columns.begin() + static_cast<std::ptrdiff_t>(i);
    };
    const auto range = [&](std::size_t i) {
      return revolution.ranges_m.begin() + static_cast<std::ptrdiff_t>(i * rings);
    };
    fragment.part.columns.assign(column(begin), column(end));
    fragment.part.ranges_m.assign(range(begin), range(end));
  }
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    fragments[i].n_fragments = static_cast<int>(fragments.size());
    fragments[i].fragment = static_cast<int>(i);
  }
  return fragments;
}

bool same_header(const LidarFragment& a, const LidarFragment& b) {
  return a.part.rings == b.part.rings;
}

std::size_t bytes_in_memory(const LidarFragment& fragment) {
  const LidarRevolution& part = fragment.part;
  return sizeof(LidarRing) * part.rings.size() + sizeof(LidarColumn) * part.columns.size() +
         sizeof(float) * part.ranges_m.size();
}

std::optional<LidarRevolution> reassemble(const FragmentSet<LidarFragment>& fragments) {
  LidarRevolution revolution;
  for (const auto& fragment : fragments.fragments()) {
    const LidarRevolution& part = fragment->part;
    revolution.utime = part.utime;
    revolution.rings = part.rings;
    revolution.columns.insert(revolution.columns.end(), part.columns.begin(), part.columns.end());
    revolution.ranges_m.insert(revolution.ranges_m.end(), part.ranges_m.begin(),
                               part.ranges_m.end());
  }
  return revolution;
}

}  // namespace adit
