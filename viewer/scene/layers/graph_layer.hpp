// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "common/types/association.hpp"
#include "viewer/scene/map_frame.hpp"
#include "viewer/server/topic_board.hpp"

namespace adit {

/// The pose graph, /graph: local maps, constraints in force and revoked loop closures.
class GraphLayer {
 public:
  /// All must outlive this.
  GraphLayer(TopicBoard& board, const MapFrame& frame);
  GraphLayer(const GraphLayer&) = delete;
  GraphLayer& operator=(const GraphLayer&) = delete;

  void add_association(const Association& association);
  void set_changed(std::int64_t utime) { board_.set_changed(topic_, utime); }

 private:
  struct Revoked {
    int older_map = 0;
    int newer_map = 0;
  };

  [[nodiscard]] std::string graph_message() const;

  TopicBoard& board_;
  const MapFrame& frame_;
  TopicId topic_ = 0;
  std::map<int, Revoked> revoked_;  ///< by id of the loop closure
};

}  // namespace adit
