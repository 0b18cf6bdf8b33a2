// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "common/bus/bus.hpp"
#include "common/types/exploration.hpp"
#include "viewer/scene/map_frame.hpp"
#include "viewer/server/topic_board.hpp"

namespace adit {

/// The frontiers with state and evidence, /frontiers, from EXPLORATION.
class FrontierLayer {
 public:
  /// All must outlive this.
  FrontierLayer(Bus& bus, TopicBoard& board, const MapFrame& frame);
  FrontierLayer(const FrontierLayer&) = delete;
  FrontierLayer& operator=(const FrontierLayer&) = delete;

 private:
  [[nodiscard]] std::string frontiers_message() const;

  const MapFrame& frame_;
  std::optional<ExplorationReport> exploration_;
};

}  // namespace adit
