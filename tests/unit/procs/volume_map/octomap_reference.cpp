// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/unit/procs/volume_map/octomap_reference.hpp"

#include <algorithm>
#include <memory>
#include <set>

namespace adit::test {
namespace {

octomap::point3d octo(const Eigen::Vector3f& p) { return {p.x(), p.y(), p.z()}; }

VoxelCode code_of(const octomap::OcTreeKey& key) {
  return VoxelGrid::code_of({key[0], key[1], key[2]});
}

octomap::OcTreeKey key_of(VoxelCode code) {
  const VoxelGrid::Keys keys = VoxelGrid::keys_at(code);
  return {static_cast<octomap::key_type>(keys.x()), static_cast<octomap::key_type>(keys.y()),
          static_cast<octomap::key_type>(keys.z())};
}

}  // namespace

OctoMapCells octomap_cells(const Cloud& cloud, double cell_m, double range_max_m) {
  octomap::OcTree tree(cell_m);
  std::set<VoxelCode> free;
  std::set<VoxelCode> occupied;
  for (const CloudLine& line : cloud.lines) {
    octomap::Pointcloud points;
    for (const Eigen::Vector3f& p : line.points) points.push_back(octo(p));
    octomap::KeySet free_keys;
    octomap::KeySet occupied_keys;
    tree.computeUpdate(points, octo(line.origin), free_keys, occupied_keys, range_max_m);
    for (const auto& key : free_keys) free.insert(code_of(key));
    for (const auto& key : occupied_keys) occupied.insert(code_of(key));
  }
  OctoMapCells cells;
  cells.occupied.assign(occupied.begin(), occupied.end());
  std::set_difference(free.begin(), free.end(), occupied.begin(), occupied.end(),
                      std::back_inserter(cells.free));
  return cells;
}

OctoMapCells our_cells(const Cloud& cloud, double cell_m, double range_max_m) {
  ScanCells found;
  for (const CloudLine& line : cloud.lines) {
    add_line(VoxelGrid(cell_m), line, range_max_m, found);
  }
  OctoMapCells cells;
  for (const CellRun& run : runs_of(found.free, found.occupied)) {
    for (VoxelCode cell = run.first; cell < run.end; ++cell) {
      (run.occupied ? cells.occupied : cells.free).push_back(cell);
    }
  }
  return cells;
}

void insert(const OctoMapCells& cells, octomap::OcTree& tree) {
  for (const VoxelCode cell : cells.free) tree.updateNode(key_of(cell), false);
  for (const VoxelCode cell : cells.occupied) tree.updateNode(key_of(cell), true);
}

std::ostream& operator<<(std::ostream& out, const Leaf& leaf) {
  return out << VoxelGrid::keys_at(leaf.first).transpose() << " depth " << leaf.depth << ": "
             << leaf.log_odds;
}

std::vector<Leaf> leaves(const octomap::OcTree& tree) {
  std::vector<Leaf> found;
  for (auto it = tree.begin_leafs(), end = tree.end_leafs(); it != end; ++it) {
    const VoxelCode cells = cells_of_node(static_cast<int>(it.getDepth()));
    found.push_back({code_of(it.getKey()) / cells * cells, it.getDepth(), it->getLogOdds()});
  }
  std::sort(found.begin(), found.end(),
            [](const Leaf& a, const Leaf& b) { return a.first < b.first; });
  return found;
}

std::vector<Leaf> leaves(const OccupancyTree& tree, const std::filesystem::path& scratch) {
  tree.write_ot(scratch);
  const std::unique_ptr<octomap::AbstractOcTree> read(
      octomap::AbstractOcTree::read(scratch.string()));
  return leaves(dynamic_cast<const octomap::OcTree&>(*read));
}

}  // namespace adit::test
