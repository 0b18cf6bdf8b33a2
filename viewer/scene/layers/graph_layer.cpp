// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/scene/layers/graph_layer.hpp"

#include <cstddef>
#include <cstdint>

#include <fmt/format.h>

#include "viewer/scene/foxglove_values.hpp"
#include "viewer/scene/topic_schema.hpp"

namespace adit {
namespace {

namespace values = foxglove_values;

constexpr std::int64_t kGraphPeriodUs = 1'000'000;

/// Adds the segment between two local maps, if both are in the graph.
void add_segment(foxglove::LinePrimitive& line, const MapFrame& frame, int from, int to) {
  const auto T_map_from = frame.T_map_local(from);
  const auto T_map_to = frame.T_map_local(to);
  if (!T_map_from || !T_map_to) return;
  values::set_point(*line.add_points(), T_map_from->translation());
  values::set_point(*line.add_points(), T_map_to->translation());
}

}  // namespace

GraphLayer::GraphLayer(TopicBoard& board, const MapFrame& frame) : board_(board), frame_(frame) {
  topic_ = board.add(protobuf_topic("/graph", *foxglove::SceneUpdate::descriptor(), kGraphPeriodUs),
                     [this] { return graph_message(); });
}

/// A loop closure may be accepted again later, or with another older map.
void GraphLayer::add_association(const Association& association) {
  const LoopClosure& loop_closure = association.loop_closure;
  if (association.revokes()) {
    const auto previous = static_cast<std::size_t>(association.previously_chosen);
    revoked_[loop_closure.id] = {loop_closure.alternatives[previous].older_map,
                                 loop_closure.newer_map};
  } else if (association.chosen != Association::kNone) {
    revoked_.erase(loop_closure.id);
  }
  set_changed(association.utime);
}

std::string GraphLayer::graph_message() const {
  using foxglove::LinePrimitive;
  const MapGraph& graph = frame_.graph();
  const std::int64_t utime = graph.utime;
  foxglove::SceneUpdate update = values::replacing_update(utime);
  const auto list = [&](const char* id, double thickness_px,
                        const values::Rgba& rgba) -> LinePrimitive& {
    return values::add_line(values::add_entity(update, utime, id), LinePrimitive::LINE_LIST,
                            thickness_px, rgba);
  };
  LinePrimitive& sequential = list("sequential", 1.5, {.r = 0.35, .g = 0.35, .b = 0.4});
  LinePrimitive& loop_closures = list("loop closures", 2.0, {.r = 0.0, .g = 0.55, .b = 0.25});
  LinePrimitive& revoked = list("revoked", 2.0, {.r = 0.8, .g = 0.1, .b = 0.1});
  for (const MapConstraint& constraint : graph.constraints) {
    const bool is_loop_closure = constraint.kind == MapConstraint::Kind::kLoopClosure;
    add_segment(is_loop_closure ? loop_closures : sequential, frame_, constraint.measured.from,
                constraint.measured.to);
  }
  for (const auto& [id, loop_closure] : revoked_)
    add_segment(revoked, frame_, loop_closure.older_map, loop_closure.newer_map);
  foxglove::SceneEntity& maps = values::add_entity(update, utime, "local maps");
  for (std::size_t i = 0; i < graph.poses.size(); ++i) {
    const auto T_map_local = frame_.T_map_local(static_cast<int>(i));
    values::add_text(maps, T_map_local->translation(), fmt::to_string(i));
  }
  return update.SerializeAsString();
}

}  // namespace adit
