// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/config/bounds.hpp"
#include "common/grid/grid2.hpp"
#include "common/types/vehicle.hpp"
#include "procs/planning/c_space/ground_layers.hpp"
#include "procs/planning/c_space/heading_set.hpp"
#include "procs/planning/c_space/kernel.hpp"
#include "procs/planning/path_cost.hpp"

namespace adit {

/// The configuration space of the vehicle (section 3.2 of the paper): the cost of each pose, by
/// cell and heading, as one grid for each heading. Headings π apart share a grid, as the outline of
/// the vehicle is symmetric.
class CSpace {
 public:
  static constexpr std::uint16_t kLethal = 0xffff;   ///< an observed obstacle blocks the pose
  static constexpr std::uint16_t kUnknown = 0xfffe;  ///< too much unobserved ground under wheels
  static constexpr std::uint16_t kEven = kEvenCost;  ///< a pose on even ground
  /// Flag of the cost of a pose in whose cell some continuous poses are lethal and others are not:
  /// a primitive through it needs an exact check.
  static constexpr std::uint16_t kMarginal = 0x8000;

  [[nodiscard]] static bool is_marginal(std::uint16_t cost) {
    return cost >= kMarginal && cost < kUnknown;
  }
  /// The cost without the flag kMarginal.
  [[nodiscard]] static std::uint16_t unmarked(std::uint16_t cost) {
    return is_marginal(cost) ? static_cast<std::uint16_t>(cost - kMarginal) : cost;
  }

  /// All poses are lethal. `headings` is even and at least 2.
  CSpace(int headings, int columns, int rows);

  [[nodiscard]] int headings() const { return headings_; }
  [[nodiscard]] int columns() const { return slices_.front().columns(); }
  [[nodiscard]] int rows() const { return slices_.front().rows(); }
  [[nodiscard]] bool contains(int column, int row) const {
    return slices_.front().contains({column, row});
  }
  /// The costs at a heading.
  [[nodiscard]] const Grid2<std::uint16_t>& slice(int heading) const {
    return slices_[slice_index(heading)];
  }
  [[nodiscard]] Grid2<std::uint16_t>& slice(int heading) { return slices_[slice_index(heading)]; }
  /// Lowers each cost to that of a C-space of the same size, if less.
  void keep_lower(const CSpace& other);
  /// Number of cells of a slice.
  [[nodiscard]] std::size_t cells() const { return slices_.front().size(); }
  /// Index of a cell in a slice.
  [[nodiscard]] std::size_t index(int column, int row) const {
    return slices_.front().index({column, row});
  }

 private:
  [[nodiscard]] std::size_t slice_index(int heading) const {
    const int half = headings_ / 2;
    return static_cast<std::size_t>(heading < half ? heading : heading - half);
  }

  int headings_;
  std::vector<Grid2<std::uint16_t>> slices_;
};

struct CSpaceParams {
  int headings = 32;                ///< a multiple of 8
  double between_weight = 0.125;    ///< of ground between the wheels; under the wheels it is 1
  double rough_factor = 6.0;        ///< cost added at roughness 1, in units of even ground
  double unknown_share_max = 0.25;  ///< of unobserved ground under the wheels
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

/// The oriented kernels of section 3.2 of the paper for a vehicle and a cell size. They yield
/// - the cost: the weighted mean roughness, with a large weight under the wheels, a small one
///   between them and none elsewhere;
/// - marginal poses: conservative kernels of the wheels and of the body, which cover every
///   continuous pose of a cell and heading, overlap lethal ground;
/// - lethal poses: the kernels shrunk by a cell, which any continuous pose covers, overlap it;
/// - unknown poses: the share of unobserved ground under the wheels is too large.
class CSpaceKernels {
 public:
  /// Throws std::invalid_argument where the cells are too small for the sums (they would overflow)
  /// or too large for the wheels.
  CSpaceKernels(const Vehicle& vehicle, const CSpaceParams& params, double cell_m);

  [[nodiscard]] const HeadingSet& headings() const { return headings_; }
  [[nodiscard]] double cell_m() const { return cell_m_; }
  /// Convolves the ground layers with all kernels, by run sums along rows.
  [[nodiscard]] CSpace convolve(const GroundLayers& layers) const;

  /// The kernels of a heading, and the factors that turn their sums into a cost.
  struct Oriented {
    RunKernel wheels;
    RunKernel body;
    RunKernel conservative_wheels;  ///< cells touched at any pose of the cell and heading
    RunKernel conservative_body;
    RunKernel lethal_wheels;  ///< shrunk by a cell; may be empty
    RunKernel lethal_body;
    RunKernel exact_wheels;  ///< at the centre of the cell and exactly at the heading
    RunKernel exact_body;
    RunKernel start_wheels;  ///< shrunk by half a cell
    RunKernel start_body;
    std::uint32_t unknown_max = 0;      ///< maximum number of unknown cells under the wheels
    std::uint64_t cost_per_wheels = 0;  ///< per unit of stored roughness, times 2³²
    std::uint64_t cost_per_body = 0;

    /// Cost of a pose that is not lethal, from the sums over `wheels` and `body`.
    [[nodiscard]] std::uint16_t cost(std::uint32_t wheel_roughness, std::uint32_t body_roughness,
                                     std::uint32_t unknown) const {
      if (unknown > unknown_max) return CSpace::kUnknown;
      return static_cast<std::uint16_t>(
          CSpace::kEven +
          ((wheel_roughness * cost_per_wheels + body_roughness * cost_per_body) >> 32U));
    }
  };
  /// The kernels of a heading; headings π apart share them.
  [[nodiscard]] const Oriented& oriented(int heading) const {
    return oriented_[static_cast<std::size_t>(heading) % oriented_.size()];
  }

 private:
  HeadingSet headings_;
  double cell_m_;
  std::uint32_t outside_roughness_;
  std::vector<Oriented> oriented_;
};

/// Exact collision check for marginal poses: it tests the cells that the vehicle covers exactly at
/// a pose or along a primitive, instead of at any continuous pose of a cell and heading.
class ExactCheck {
 public:
  /// `reach` is the maximum reach of the kernels that will be checked.
  ExactCheck(const GroundLayers& layers, int reach)
      : body_(layers.columns(), layers.rows(), reach, 0, Of{layers, layers.under_body}),
        wheels_(layers.columns(), layers.rows(), reach, 0, Of{layers, layers.under_wheels}),
        unknown_(layers.columns(), layers.rows(), reach, 1, Of{layers, layers.unknown}) {}

  /// Whether the kernels centred at a cell of the map overlap no lethal ground.
  [[nodiscard]] bool is_free(const RunKernel& body, const RunKernel& wheels, int column,
                             int row) const {
    return body_.around(body, column, row) == 0 && wheels_.around(wheels, column, row) == 0;
  }
  /// Whether the kernel overlaps unobserved ground, where an obstacle may stand.
  [[nodiscard]] bool is_unknown(const RunKernel& body, int column, int row) const {
    return unknown_.around(body, column, row) != 0;
  }

 private:
  struct Of {
    const GroundLayers& layers;
    const CellLayer& layer;
    std::uint8_t operator()(int column, int row) const { return layer[layers.index(column, row)]; }
  };

  RowSums<std::uint16_t> body_;
  RowSums<std::uint16_t> wheels_;
  RowSums<std::uint16_t> unknown_;
};

}  // namespace adit
