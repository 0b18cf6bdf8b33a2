// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fuzz/mutator.hpp"

#include <algorithm>
#include <array>

namespace adit::fuzz {
namespace {

constexpr std::size_t kFingerprint = 8;
constexpr std::array<std::uint32_t, 10> kBoundaryValues{
    0, 1, 0xFFFFFFFF, 0x80000000, 0x7FFFFFFF, 0x40000000, 0x20000001, 1000, 0x7FF80000, 0xFF};

}  // namespace

/// SplitMix64 (Steele, Lea and Flood, 2014).
std::uint64_t Mutator::random() {
  state_ += 0x9E3779B97F4A7C15U;
  std::uint64_t z = state_;
  z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
  z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
  return z ^ (z >> 31U);
}

std::size_t Mutator::below(std::size_t end) { return end == 0 ? 0 : random() % end; }

/// A random position, usually behind the message fingerprint: a decoder rejects a wrong fingerprint
/// before it decodes anything.
std::size_t Mutator::position(const Bytes& bytes) {
  const bool anywhere = bytes.size() <= kFingerprint || below(16) == 0;
  return anywhere ? below(bytes.size()) : kFingerprint + below(bytes.size() - kFingerprint);
}

Bytes Mutator::mutate(const std::vector<Bytes>& samples, const Bytes& other_sample) {
  if (below(64) == 0) return noise(200);
  Bytes bytes = samples[below(samples.size())];
  const bool keep_length = below(2) == 0;  // inputs of the right length get furthest
  for (std::size_t times = 1 + below(4); times > 0; --times) {
    keep_length ? change(bytes) : damage(bytes, other_sample);
  }
  return bytes;
}

void Mutator::change(Bytes& bytes) {
  if (bytes.empty()) return;
  std::uint8_t& byte = bytes[position(bytes)];
  switch (below(3)) {
    case 0:
      byte = static_cast<std::uint8_t>(random());
      break;
    case 1:
      byte ^= static_cast<std::uint8_t>(1U << below(8));
      break;
    default:
      set_number(bytes);
      break;
  }
}

void Mutator::damage(Bytes& bytes, const Bytes& other_sample) {
  if (bytes.empty()) return insert(bytes, noise(20));
  const auto at = static_cast<std::ptrdiff_t>(position(bytes));
  const auto length =
      static_cast<std::ptrdiff_t>(below(bytes.size() - static_cast<std::size_t>(at)));
  switch (below(6)) {
    case 0:
      bytes.resize(static_cast<std::size_t>(at));
      break;
    case 1:
      insert(bytes, noise(20));
      break;
    case 2:
      insert(bytes, part_of(other_sample));
      break;
    case 3:
      insert(bytes, part_of(bytes));
      break;
    case 4:
      bytes.erase(bytes.begin() + at, bytes.begin() + at + length);
      break;
    default:
      change(bytes);
      break;
  }
}

/// Overwrites four bytes with a boundary value: a count, a length or half of a double.
void Mutator::set_number(Bytes& bytes) {
  const std::uint32_t number = kBoundaryValues[below(kBoundaryValues.size())];
  const std::size_t at = position(bytes);
  for (std::size_t i = 0; i < 4 && at + i < bytes.size(); ++i) {
    bytes[at + i] = static_cast<std::uint8_t>(number >> (24 - 8 * i));
  }
}

void Mutator::insert(Bytes& bytes, const Bytes& part) {
  const auto at = static_cast<std::ptrdiff_t>(position(bytes));
  bytes.insert(bytes.begin() + at, part.begin(), part.end());
}

Bytes Mutator::part_of(const Bytes& bytes) {
  const std::size_t at = below(bytes.size());
  const std::size_t length = below(bytes.size() - at);
  const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(at);
  return {begin, begin + static_cast<std::ptrdiff_t>(length)};
}

Bytes Mutator::noise(std::size_t longest) {
  Bytes bytes(below(longest + 1));
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
  return bytes;
}

}  // namespace adit::fuzz
