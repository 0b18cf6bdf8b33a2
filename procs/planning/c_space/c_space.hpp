// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "common/config/bounds.hpp"
#include "common/types/vehicle.hpp"
#include "procs/planning/c_space/ground_layers.hpp"
#include "procs/planning/c_space/heading_set.hpp"
#include "procs/planning/c_space/kernel.hpp"

namespace adit {

/// What a pose of the vehicle costs, by cell and heading.
class CSpace {
 public:
  static constexpr std::uint16_t kLethal = 0xffff;   ///< something that was seen is in the way
  static constexpr std::uint16_t kUnknown = 0xfffe;  ///< too much under the wheels was not seen
  static constexpr std::uint16_t kEven = 100;        ///< a pose on even ground
  /// Marks the cost of a pose that may be lethal, or not, by where in its cell and how the vehicle
  /// stands: who comes through has to look closely.
  static constexpr std::uint16_t kMarginal = 0x8000;

  [[nodiscard]] static bool is_marginal(std::uint16_t cost) {
    return cost >= kMarginal && cost < kUnknown;
  }
  /// Without the mark.
  [[nodiscard]] static std::uint16_t unmarked(std::uint16_t cost) {
    return is_marginal(cost) ? static_cast<std::uint16_t>(cost - kMarginal) : cost;
  }

  /// Headings π apart share their costs, the vehicle being symmetric.
  CSpace(int headings, int columns, int rows);

  [[nodiscard]] int headings() const { return headings_; }
  [[nodiscard]] int columns() const { return columns_; }
  [[nodiscard]] int rows() const { return rows_; }
  [[nodiscard]] bool contains(int column, int row) const {
    return column >= 0 && row >= 0 && column < columns_ && row < rows_;
  }
  /// The costs at a heading, row by row.
  [[nodiscard]] const std::uint16_t* slice(int heading) const {
    const int half = headings_ / 2;
    return costs_.data() +
           static_cast<std::size_t>(heading < half ? heading : heading - half) * cells();
  }
  [[nodiscard]] std::uint16_t* slice(int heading) {
    return const_cast<std::uint16_t*>(std::as_const(*this).slice(heading));
  }
  [[nodiscard]] std::size_t cells() const {
    return static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  }
  [[nodiscard]] std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }

 private:
  int headings_;
  int columns_;
  int rows_;
  std::vector<std::uint16_t> costs_;
};

struct CSpaceParams {
  int headings = 32;              ///< a multiple of 8
  double between_weight = 0.125;  ///< of ground between the wheels, that under them having 1
  double rough_factor = 6.0;      ///< a pose at the limit costs this much more than on even ground
  double unknown_share_max = 0.25;  ///< of the ground under the wheels
  GroundLimits ground;

  template <class V>
  void visit(V& v) {
    v("headings", headings, within(8, 128));
    v("between_weight", between_weight, within(0.0, 1.0));
    v("rough_factor", rough_factor, within(0.0, 100.0));
    v("unknown_share_max", unknown_share_max, within(0.0, 1.0));
    v("ground", ground);
  }
};

/// The oriented kernels of the paper's section 3.2 for a vehicle and a size of cells.
/// - cost: the mean roughness with most weight under the wheels, little between, none beyond
/// - close: kernels that miss nothing under rotation and the size of cells, one for what the wheels
///   must not meet, one for what nothing of the vehicle must
/// - lethal: the same less a cell all round, which meet that at any pose of the cell and heading
/// - unseen: the share of the ground under the wheels
class CSpaceKernels {
 public:
  /// Throws std::invalid_argument where the cells are so small that sums would run over.
  CSpaceKernels(const Vehicle& vehicle, const CSpaceParams& params, double cell_m);

  [[nodiscard]] const HeadingSet& headings() const { return headings_; }
  [[nodiscard]] double cell_m() const { return cell_m_; }
  [[nodiscard]] CSpace convolve(const GroundLayers& layers) const;

  /// The kernels of a heading, and what turns their sums into a cost.
  struct Oriented {
    RunKernel wheels;  ///< as they are
    RunKernel body;
    RunKernel conservative_wheels;  ///< conservative
    RunKernel conservative_body;
    RunKernel lethal_wheels;  ///< may be empty
    RunKernel lethal_body;
    RunKernel exact_wheels;  ///< of the pose in the middle of the cell, at the heading itself
    RunKernel exact_body;
    RunKernel start_wheels;  ///< less half a cell all round
    RunKernel start_body;
    std::uint32_t unknown_max = 0;      ///< cells under the wheels
    std::uint64_t cost_per_wheels = 0;  ///< of roughness 1, times 2³²
    std::uint64_t cost_per_body = 0;

    /// Of a pose that is not lethal.
    [[nodiscard]] std::uint16_t cost(std::uint32_t wheel_roughness, std::uint32_t body_roughness,
                                     std::uint32_t unknown) const {
      if (unknown > unknown_max) return CSpace::kUnknown;
      return static_cast<std::uint16_t>(
          CSpace::kEven +
          ((wheel_roughness * cost_per_wheels + body_roughness * cost_per_body) >> 32U));
    }
  };
  /// Of a heading; those π apart are the same.
  [[nodiscard]] const Oriented& oriented(int heading) const {
    return oriented_[static_cast<std::size_t>(heading) % oriented_.size()];
  }

 private:
  HeadingSet headings_;
  double cell_m_;
  std::uint32_t outside_roughness_;
  std::vector<Oriented> oriented_;
};

/// What is lethal or was not seen, looked at closely: under the vehicle exactly where it is or
/// comes through, not anywhere in a cell and about at a heading.
class ExactCheck {
 public:
  /// `reach` is the greatest of the kernels that are asked about.
  ExactCheck(const GroundLayers& layers, int reach)
      : body_(layers.columns, layers.rows, reach, 0, Of{layers, layers.under_body}),
        wheels_(layers.columns, layers.rows, reach, 0, Of{layers, layers.under_wheels}),
        unseen_(layers.columns, layers.rows, reach, 1, Of{layers, layers.unknown}) {}

  /// Whether these kernels around a cell of the map meet nothing lethal.
  [[nodiscard]] bool is_free(const RunKernel& body, const RunKernel& wheels, int column,
                             int row) const {
    return body_.around(body, column, row) == 0 && wheels_.around(wheels, column, row) == 0;
  }
  /// Whether this kernel meets ground that was not seen, where anything may stand.
  [[nodiscard]] bool is_unknown(const RunKernel& body, int column, int row) const {
    return unseen_.around(body, column, row) != 0;
  }

 private:
  struct Of {
    const GroundLayers& layers;
    const std::vector<std::uint8_t>& layer;
    std::uint8_t operator()(int column, int row) const { return layer[layers.index(column, row)]; }
  };

  RowSums<std::uint16_t> body_;
  RowSums<std::uint16_t> wheels_;
  RowSums<std::uint16_t> unseen_;
};

}  // namespace adit
