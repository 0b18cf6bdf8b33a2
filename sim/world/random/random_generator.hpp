// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <random>

namespace adit {

/// The random numbers of one mine.
class RandomGenerator {
 public:
  explicit RandomGenerator(std::uint64_t seed) : random_(seed) {}

  /// Uniform.
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  /// Uniform, both ends included.
  int between(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  bool chance(double share) { return between(0.0, 1.0) < share; }
  /// 1 or −1.
  double side() { return chance(0.5) ? 1.0 : -1.0; }

 private:
  std::mt19937_64 random_;
};

}  // namespace adit
