// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/export/ros2/occupancy_topic.hpp"

#include <cstddef>

#include "common/bus/log/event_source.hpp"
#include "viewer/scene/foxglove_values.hpp"

namespace adit {
namespace {

constexpr std::int64_t kMapPeriodUs = 10'000'000;

ros2::OccupancyCells occupancy(const TopicMessage& message) {
  constexpr std::size_t kField = 4;  // occupancy, behind red, green, blue and alpha
  foxglove::Grid grid;
  grid.ParseFromString(*message.bytes);
  ros2::OccupancyCells map;
  map.utime = message.utime;
  map.cell_m = grid.cell_size().x();
  map.T_map_grid = {grid.pose().position().x(), grid.pose().position().y(), 0.0};
  map.columns = grid.column_count();
  map.rows = grid.row_stride() == 0
                 ? 0
                 : static_cast<std::uint32_t>(grid.data().size() / grid.row_stride());
  for (std::size_t cell = kField; cell < grid.data().size(); cell += grid.cell_stride())
    map.cells.push_back(grid.data()[cell]);
  return map;
}

}  // namespace

OccupancyTopic::OccupancyTopic(const SceneParameters& parameters)
    : scene_(bus_, board_, parameters) {
  for (TopicId topic = 0; topic < board_.topics().size(); ++topic) {
    if (board_.topics()[topic].name == "/map") map_ = topic;
  }
}

std::optional<ros2::OccupancyCells> OccupancyTopic::play(const LogEventView& event) {
  if (!is_playable_after(event.utime, bus_.now_utime())) return std::nullopt;
  bus_.inject(event.utime, event.channel, event.data);
  if (event.utime < next_utime_) return std::nullopt;
  next_utime_ = event.utime + kMapPeriodUs;
  return newest(board_.take_due(event.utime, [this](TopicId topic) { return topic == map_; }));
}

std::optional<ros2::OccupancyCells> OccupancyTopic::newest(
    const std::vector<TopicBoard::Update>& updates) const {
  std::optional<ros2::OccupancyCells> found;
  for (const auto& [topic, message] : updates) {
    if (topic == map_) found = occupancy(message);
  }
  return found;
}

}  // namespace adit
