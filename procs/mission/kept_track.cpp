// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mission/kept_track.hpp"

#include <array>

#include "common/journal/value_bytes.hpp"

namespace adit {
namespace {

struct Record {
  std::int64_t odom_utime = 0;
  std::array<double, 3> T_odom_body{};
  std::array<double, 3> T_map_odom{};
  std::int64_t on_map = 0;  // as wide as the others, so that all bytes mean something
  std::int64_t tied = 0;
};

std::array<double, 3> numbers(const Pose2& pose) { return {pose.x, pose.y, pose.theta}; }
Pose2 pose(const std::array<double, 3>& numbers) { return {numbers[0], numbers[1], numbers[2]}; }

}  // namespace

std::vector<std::uint8_t> to_bytes(const KeptPlace& place) {
  const Record record{place.odom_utime, numbers(place.T_odom_body),
                      numbers(place.T_map_odom.value_or(Pose2{})),
                      place.T_map_odom.has_value() ? 1 : 0, place.tied ? 1 : 0};
  const auto bytes = bytes_of(record);
  return {bytes.begin(), bytes.end()};
}

std::optional<KeptPlace> kept_place_from(std::span<const std::uint8_t> bytes) {
  const auto record = value_from<Record>(bytes);
  if (!record) return std::nullopt;
  KeptPlace place{record->odom_utime, pose(record->T_odom_body), {}, record->tied != 0};
  if (record->on_map != 0) place.T_map_odom = pose(record->T_map_odom);
  return place;
}

OwnTrack track_of(const std::vector<KeptPlace>& places) {
  OwnTrack track;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (i > 0 && places[i].odom_utime != places[i - 1].odom_utime) {
      track.begin_anew(places[i - 1].T_map_odom);
    }
    if (places[i].tied && places[i].T_map_odom) track.tie(*places[i].T_map_odom);
    track.add(0, places[i].T_odom_body);
  }
  return track;
}

}  // namespace adit
