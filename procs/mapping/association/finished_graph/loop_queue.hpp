// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "procs/mapping/association/finished_graph/loop_order.hpp"
#include "procs/mapping/association/lazy_association.hpp"

namespace adit {

/// The loop closures of a file that wait for their decision, in order of their newer map, with
/// their groups. Decided first are those that the present map tells from wrong ones, most certain
/// first; then, where it tells none, the group that agrees most within itself; then those that are
/// rather right than wrong if they fit. Others remain. In the paper's order: by their newer map.
class LoopQueue {
 public:
  /// `association` has all maps, and outlives this object.
  LoopQueue(std::vector<LoopClosure> loop_closures, LazyAssociation& association,
            const LazyAssociationParams& params);

  /// Indices of the loop closures to decide next, at most `most`; empty if none is left or all
  /// others remain undecided. They are no longer in the queue.
  std::vector<int> next(std::size_t most);
  /// All that are left.
  [[nodiscard]] std::vector<int> remaining() const;

  /// Copies of these loop closures, and the group of each.
  [[nodiscard]] std::pair<std::vector<LoopClosure>, std::vector<int>> with_groups(
      const std::vector<int>& loops) const;
  /// Notes which loops are accepted now.
  void set_accepted(std::vector<int> accepted) { accepted_ = std::move(accepted); }

 private:
  std::vector<int> next_in_time(std::size_t most);
  [[nodiscard]] std::vector<int> best_supported(const std::vector<int>& candidates) const;
  [[nodiscard]] std::vector<int> agreeing_members(int group) const;
  [[nodiscard]] bool agree(int a, int b) const;

  LazyAssociation& association_;
  double gate_;
  std::vector<LoopClosure> loop_closures_;
  std::vector<int> groups_;
  std::vector<std::vector<int>> members_;  // of each group
  std::vector<int> accepted_;
  std::optional<LoopOrder> order_;  // none in the paper's order
  std::size_t next_ = 0;            // in the paper's order
};

}  // namespace adit
