// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "common/pose_graph/pose_graph.hpp"

namespace adit {

/// A pose graph and the ids of its nodes in a file.
struct G2oGraph {
  PoseGraph graph;
  std::vector<long> ids;  ///< id of each pose
};

/// An error in a file, as `file:line: reason`.
class G2oError : public std::runtime_error {
 public:
  G2oError(const std::string& file, std::size_t line, const std::string& reason)
      : std::runtime_error(fmt::format("{}:{}: {}", file, line, reason)), line_(line) {}
  [[nodiscard]] std::size_t line() const { return line_; }

 private:
  std::size_t line_;
};

/// Reads a planar pose graph, plain or gzip, in either of two formats:
///   VERTEX_SE2 id x y θ, EDGE_SE2 i j x y θ I11 I12 I13 I22 I23 I33   (g2o)
///   VERTEX2 id x y θ, EDGE2 i j x y θ I11 I12 I22 I33 I13 I23         (TORO)
/// in metres and radians; an edge is the pose of j in the frame of i in both. `#` starts a comment.
/// Nodes are in ascending order of their ids, so that pose 0 has the lowest id; `FIX id` may name
/// this node only, as another choice only moves the complete graph. Without vertices the poses are
/// chained odometry from the origin.
///
/// Throws G2oError for the first invalid line: an unknown tag, a number that is not finite, an edge
/// from a node to itself or to a node without a vertex (if there are vertices), a vertex defined
/// twice, information with a negative eigenvalue. Throws std::runtime_error if the file cannot be
/// read.
G2oGraph read_g2o(const std::filesystem::path& path);

/// A run to add to a graph: further poses, and constraints between them and with its poses.
struct G2oRun {
  std::vector<long> ids;  ///< of the further poses
  std::vector<PoseConstraint>
      constraints;  ///< indices of further poses continue those of the graph
};

/// Reads a run in the same formats. Edges may name ids of the graph, which are not vertices of the
/// run; poses of vertices are not used. Throws as `read_g2o`, also for a vertex that the graph has.
G2oRun read_g2o_run(const std::filesystem::path& path, const G2oGraph& graph);

/// Writes a graph in the g2o format, each number with the fewest digits that read back as the same
/// value; gzip if the name ends in ".gz". Throws std::runtime_error if the file cannot be written.
void write_g2o(const G2oGraph& graph, const std::filesystem::path& path);

}  // namespace adit
