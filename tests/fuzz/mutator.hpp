// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "tests/fuzz/targets.hpp"

namespace adit::fuzz {

/// Damages good inputs. What it does follows from the seed alone, on every machine.
class Mutator {
 public:
  explicit Mutator(std::uint64_t seed) : state_(seed) {}

  /// A damaged copy of one of the samples: bits flipped, numbers set to awkward ones, ends cut off
  /// or added, parts taken out, repeated or taken from `stranger`; or nothing but noise.
  Bytes mutate(const std::vector<Bytes>& samples, const Bytes& other_sample);

 private:
  std::uint64_t random();
  std::size_t below(std::size_t end);
  std::size_t position(const Bytes& bytes);

  void change(Bytes& bytes);
  void damage(Bytes& bytes, const Bytes& other_sample);
  void set_number(Bytes& bytes);
  void insert(Bytes& bytes, const Bytes& part);
  Bytes part_of(const Bytes& bytes);
  Bytes noise(std::size_t longest);

  std::uint64_t state_;
};

}  // namespace adit::fuzz
