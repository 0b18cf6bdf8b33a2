// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "common/bus/bus.hpp"
#include "common/messages/mapping/local_map.hpp"
#include "common/messages/mapping/pose_graph.hpp"
#include "common/pose_graph/map_graph.hpp"
#include "common/types/association.hpp"
#include "common/types/local_map.hpp"
#include "common/types/map_contradictions.hpp"

namespace adit {

/// Receives the output of mapping: LOCAL_MAP and POSE_GRAPH, reassembled from their fragments,
/// ASSOCIATION and CONTRADICTIONS.
class MapSubscription {
 public:
  struct Handlers {
    std::function<void(LocalMap)> on_local_map;
    std::function<void(MapGraph)> on_graph;
    std::function<void(const Association&)> on_association;
    std::function<void(MapContradictions)> on_contradictions;
  };

  /// Must be called once. `bus` must not deliver messages after this is destroyed.
  void subscribe(Bus& bus, Handlers handlers);

 private:
  Handlers handlers_;
  LocalMapReassembler local_map_fragments_;
  PoseGraphReassembler graph_fragments_;
};

}  // namespace adit
