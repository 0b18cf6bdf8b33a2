// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "common/pose_graph/pose_graph.hpp"
#include "procs/mapping/association/finished_graph/graph_odometry.hpp"

namespace adit {

/// Whether the odometry loses its heading: its standard deviation from the first pose to the last
/// exceeds half a turn. Residuals to first order along the odometry, and an order of decisions by
/// them, then mean nothing over long stretches.
bool loses_heading(const GraphOdometry& odometry);

/// Loops that agree with each other and with one map.
struct LoopConsensus {
  std::vector<bool> accepted;     ///< of each constraint; odometry and bridges are
  std::vector<Pose2> T_map_node;  ///< the optimum under the accepted constraints
  bool is_certified = false;      ///< it is proven to be the global one (`certify`)
  /// An accepted loop does not fit the map without its group, those near it along the odometry: the
  /// group may be wrong.
  bool is_contradictory = false;
};

/// Selects the loops of a graph whose odometry loses its heading. The first map is the optimum of
/// those that neighbours support: loops near each other along the odometry at both ends, whose
/// cycle is short, and which would hardly agree by chance. Then all are tested at the map, each
/// without itself: it must fit, and hardly by chance. The map is optimised again until
/// nothing changes, also at the certified optimum. Errors of loops may be smaller than
/// their information claims; their scale is estimated.
///
/// `gate`: chi-square up to which a loop fits, at full scale. Nothing if neighbours support no
/// loop, or if the selection does not settle or rejects more than a twentieth of the supported
/// loops: then groups contradict each other, between which this selection does not search.
std::optional<LoopConsensus> find_consensus(const PoseGraph& graph, const GraphOdometry& odometry,
                                            double gate);

}  // namespace adit
