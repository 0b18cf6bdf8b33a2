// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "common/config/config_file.hpp"
#include "tools/campaign/definition/parameter_matrix.hpp"

namespace adit {

/// One parameter of a search, from section `space` of its file.
struct SpaceParameter {
  enum class Kind {
    kReal,     ///< {from: 0, to: 1, simple: 0}
    kInteger,  ///< {from: 30, to: 80, simple: 30, integer: true}
    kChoice,   ///< [branching, ring], the first is the simplest
    kSeed      ///< {seed: true}: any integer from 1; neighbours have nothing in common
  };

  std::string name;
  Kind kind = Kind::kReal;
  double from = 0.0;
  double to = 1.0;
  double simple = 0.0;                  ///< toward which failures are shrunk
  std::vector<ParameterValue> choices;  ///< of kChoice, whose values are indices

  [[nodiscard]] bool is_range() const { return kind == Kind::kReal || kind == Kind::kInteger; }
  /// The nearest value that is written: within the range, an integer, or of a real parameter one
  /// with this number of digits behind that of the width of the range.
  [[nodiscard]] double rounded(double value, int digits = 3) const;
  [[nodiscard]] ParameterValue written(double value) const;
};

/// A value for each parameter of the space; of a choice its index.
using SearchPoint = std::vector<double>;

/// The parameters over which a search runs.
struct SearchSpace {
  std::vector<SpaceParameter> parameters;

  [[nodiscard]] SearchPoint simplest() const;
  [[nodiscard]] UnitParameters values(const SearchPoint& point) const;
  /// Number of parameters that are not simple, and as fraction their mean distance from there.
  [[nodiscard]] double complexity(const SearchPoint& point) const;
};

/// Reads the section `space`. Throws ConfigError.
SearchSpace load_space(const ConfigFile& file);

}  // namespace adit
