// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "tests/fuzz/targets.hpp"

namespace adit::fuzz {

/// Mutates valid inputs. The result depends only on the seed and is the same on every machine.
class Mutator {
 public:
  explicit Mutator(std::uint64_t seed) : state_(seed) {}

  /// A mutated copy of one of the samples: bits flipped, numbers replaced by boundary values, the
  /// end truncated, parts removed, repeated or inserted from `other_sample`; or random bytes.
  Bytes mutate(const std::vector<Bytes>& samples, const Bytes& other_sample);

  /// 64 random bits.
  std::uint64_t random();
  /// A random number less than `end`; 0 if that is 0.
  std::size_t below(std::size_t end);

 private:
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
