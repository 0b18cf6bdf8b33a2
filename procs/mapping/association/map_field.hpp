// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "common/pose_graph/incremental_field.hpp"
#include "procs/mapping/association/association_problem.hpp"

namespace adit {

/// The field of the current hypothesis while the map grows. It follows the hypothesis at the cost
/// of what has changed: new maps, loop closures that were accepted or revoked, maps that were
/// moved.
class MapField {
 public:
  /// Adds, removes and moves what differs from the hypothesis of the complete problem, and
  /// linearises again each map whose mode is farther than `kMovedM` or `kMovedRad` from its
  /// linearisation.
  void follow(const AssociationProblem& problem, const Hypothesis& hypothesis);
  /// Removes the maps and loop closures after the first ones: others may take their places.
  void truncate(int maps, std::size_t loop_closures);

  /// Adds the constraint of an alternative of an undecided loop closure.
  void accept(const AssociationProblem& problem, int loop_closure, int alternative);
  /// Linearises again as above. False if no map is as far.
  bool relinearise();
  /// Whether so many maps are as far that one factorisation of all is cheaper.
  [[nodiscard]] bool is_mostly_far() const;

  [[nodiscard]] const IncrementalField& field() const { return field_; }
  /// The constraint in the field that is the displacement of a map, not the first, from the one
  /// before.
  [[nodiscard]] int displacement(int map) const { return chain_[as_index(map) - 1]; }
  /// T_map_local of all maps at the mode.
  [[nodiscard]] const std::vector<Pose2>& poses() const { return poses_; }
  /// The largest turn of a map by the mode that is not linearised yet [rad].
  [[nodiscard]] double largest_turn() const;

  /// A linearisation this near has errors of the second order; the optimum is found to 0.5 mm.
  static constexpr double kMovedM = 1e-3;
  static constexpr double kMovedRad = 1e-4;
  /// A change of the maps on which others depend that does not move these [m, rad].
  static constexpr double kUnchanged = 1e-6;

 private:
  void add_maps(const AssociationProblem& problem, const Hypothesis& hypothesis);
  void choose(const AssociationProblem& problem, std::size_t loop_closure, int alternative);
  void update(bool only_new_maps);
  [[nodiscard]] bool is_far(int map) const;

  struct Chosen {
    int alternative = Association::kNone;
    int constraint = -1;  ///< in the field
  };

  IncrementalField field_{kUnchanged};
  std::vector<int> chain_;      // of each map but the first: its constraint in the field
  std::vector<Chosen> chosen_;  // of each loop closure
  std::vector<Pose2> poses_;
  std::vector<Pose2> followed_;  // of the last hypothesis, which need not be at the mode
  std::vector<int> displaced_;   // maps whose mode is not zero
};

}  // namespace adit
