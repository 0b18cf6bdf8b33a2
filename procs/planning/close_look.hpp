// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "procs/planning/ground_layers.hpp"
#include "procs/planning/row_sums.hpp"

namespace adit {

/// What is lethal or was not seen, looked at closely: under the vehicle exactly where it is or
/// comes through, not anywhere in a cell and about at a heading.
class CloseLook {
 public:
  /// `reach` is the greatest of the kernels that are asked about.
  CloseLook(const GroundLayers& layers, int reach)
      : body_(layers.columns, layers.rows, reach, 0, Of{layers, layers.under_body}),
        wheels_(layers.columns, layers.rows, reach, 0, Of{layers, layers.under_wheels}),
        unseen_(layers.columns, layers.rows, reach, 1, Of{layers, layers.unseen}) {}

  /// Whether these kernels around a cell of the map meet nothing lethal.
  [[nodiscard]] bool is_free(const RunKernel& body, const RunKernel& wheels, int column,
                             int row) const {
    return body_.around(body, column, row) == 0 && wheels_.around(wheels, column, row) == 0;
  }
  /// Whether this kernel meets ground that was not seen, where anything may stand.
  [[nodiscard]] bool is_unseen(const RunKernel& body, int column, int row) const {
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
