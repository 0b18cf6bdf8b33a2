// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "common/grid/grid2.hpp"

namespace adit {

/// What a local map observed, coarsely.
struct MapFootprint {
  static constexpr double kCellM = 1.0;

  /// One for each coarse cell: its middle, and the mean height of the beams in it [m].
  std::vector<Eigen::Vector3d> points;
  double z_variance = 0.0;  ///< of these heights [m²]
};

/// Most layers of a map.
constexpr int kLayersMax = 64;

/// Separates local maps into layers, such that in no layer two local maps lie above each other:
/// their beams have the same place in plan at heights that differ by more than a tunnel and three
/// standard deviations allow. Any two local maps that observe the same place at the same height
/// share a layer, unless kLayersMax are not enough; so a local map is in several layers where they
/// meet. `footprints` by the id of the local map, in map; empty for one without a pose. Returns the
/// layers of each local map, the first one being its own; {0} for all where heights are unknown or
/// nothing lies above anything else. A local map adds to the layers of those before it, but never
/// changes the first one.
std::vector<std::vector<int>> separate_layers(const std::vector<MapFootprint>& footprints);

/// Where the layers lie in atlas: the plane in which each layer of map has an area of its own, side
/// by side along y. Layer 0 lies as in map, so that with a single layer both are the same. The
/// displacement of the others grows in large steps with the mine.
class Atlas {
 public:
  /// `boxes`: the cells of each layer, in map.
  explicit Atlas(const std::vector<CellBox>& boxes = {}, double resolution_m = 1.0);

  [[nodiscard]] int layers() const { return static_cast<int>(shift_.size()); }
  [[nodiscard]] int layer_of(const Eigen::Vector2d& p_atlas) const;
  [[nodiscard]] int layer_of_row(int row) const;
  /// Rows by which a layer is displaced.
  [[nodiscard]] int shift(int layer) const { return shift_[static_cast<std::size_t>(layer)]; }
  [[nodiscard]] Eigen::Vector2d displacement(int layer) const {
    return {0.0, resolution_m_ * shift(layer)};
  }
  [[nodiscard]] Eigen::Vector2d to_atlas(const Eigen::Vector2d& p_map, int layer) const {
    return p_map + displacement(layer);
  }
  [[nodiscard]] Eigen::Vector2d to_map(const Eigen::Vector2d& p_atlas) const {
    return p_atlas - displacement(layer_of(p_atlas));
  }

 private:
  double resolution_m_;
  std::vector<int> shift_{0};  ///< by layer
  std::vector<int> first_row_{0};
};

/// Cells of an atlas that are the same place: a local map of several layers observed it. None with
/// a single layer.
class SharedCells {
 public:
  SharedCells() = default;
  SharedCells(const Atlas& atlas, const CellBox& box) : atlas_(atlas), layers_(box) {}

  /// A cell, in map, is the same place in these layers.
  void add(const Eigen::Vector2i& cell_map, const std::vector<int>& layers);

  [[nodiscard]] int layer_of(std::size_t cell) const {
    return atlas_.layer_of_row(layers_.cell(cell).y());
  }
  /// The cell of another layer above or below a cell.
  [[nodiscard]] std::size_t in_layer(std::size_t cell, int layer) const {
    const int rows = atlas_.shift(layer) - atlas_.shift(layer_of(cell));
    return cell + static_cast<std::size_t>(std::ptrdiff_t{rows} * layers_.columns());
  }
  /// Calls `visit(cell, layer)` for each other cell that is the same place.
  template <class Visit>
  void for_each(std::size_t cell, const Visit& visit) const {
    if (layers_.size() == 0 || layers_[cell] == 0) return;
    const int own = layer_of(cell);
    for (std::uint64_t left = layers_[cell]; left != 0; left &= left - 1) {
      const int layer = std::countr_zero(left);
      if (layer != own) visit(in_layer(cell, layer), layer);
    }
  }
  /// Whether the cell is the same place as one of a lower number of layer.
  [[nodiscard]] bool is_repeated(std::size_t cell) const {
    if (layers_.size() == 0 || layers_[cell] == 0) return false;
    return std::countr_zero(layers_[cell]) < layer_of(cell);
  }

 private:
  Atlas atlas_;
  Grid2<std::uint64_t> layers_;  ///< bit mask by cell, with its own layer; 0 where not shared
};

}  // namespace adit
