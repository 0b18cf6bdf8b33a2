// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/message_fields.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace adit {
namespace {

/// Bytes of a field that hold its number; of a text, its length.
std::size_t number_bytes(const FieldPlace& place) {
  return place.kind == FieldPlace::Kind::kText ? sizeof(std::int32_t) : place.bytes;
}

template <class Float, class Bits>
void add_floats(const Quantity& quantity, std::vector<std::uint64_t>& bits) {
  using Limits = std::numeric_limits<Float>;
  const auto add = [&bits](Float number) { bits.push_back(std::bit_cast<Bits>(number)); };
  for (const Float number :
       {Float{0}, Limits::denorm_min(), Limits::min() / 2, Limits::epsilon(), Float{1}, Float(1e3),
        Float(1e6), Float(1e9), Float(1e20), Limits::max() / 2, Limits::max(), Limits::infinity(),
        Limits::quiet_NaN(), Limits::signaling_NaN()}) {
    add(number);
    add(-number);
  }
  for (const double end : {quantity.min, quantity.max}) {
    if (!std::isfinite(end) || std::abs(end) > static_cast<double>(Limits::max())) continue;
    const auto number = static_cast<Float>(end);
    add(number);
    add(std::nextafter(number, -Limits::infinity()));
    add(std::nextafter(number, Limits::infinity()));
    add(static_cast<Float>(0.999 * number));
  }
}

void add_integers(const FieldPlace& place, std::vector<std::uint64_t>& bits) {
  const std::size_t n_bits = 8 * number_bytes(place);
  const std::uint64_t sign = std::uint64_t{1} << (n_bits - 1);
  for (const std::uint64_t number :
       {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{2}, std::uint64_t{100}, ~std::uint64_t{0},
        sign, sign - 1, sign + 1, sign / 2, sign / 1000}) {
    bits.push_back(number);
  }
  for (const double end : {place.quantity.min, place.quantity.max}) {
    if (std::abs(end) > 9e18) continue;
    const auto number = static_cast<std::int64_t>(end);
    for (const std::int64_t near : {number - 2, number - 1, number, number + 1, number + 2})
      bits.push_back(static_cast<std::uint64_t>(near));
  }
}

}  // namespace

std::uint64_t read_bits(const std::vector<std::uint8_t>& message, const FieldPlace& place) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < number_bytes(place); ++i)
    bits = bits << 8U | message.at(place.offset + i);
  return bits;
}

void write_bits(const FieldPlace& place, std::uint64_t bits, std::vector<std::uint8_t>& message) {
  for (std::size_t i = number_bytes(place); i > 0; --i, bits >>= 8U)
    message.at(place.offset + i - 1) = static_cast<std::uint8_t>(bits);
}

double number_of(const FieldPlace& place, std::uint64_t bits) {
  if (place.kind == FieldPlace::Kind::kFloat && place.bytes == sizeof(float))
    return std::bit_cast<float>(static_cast<std::uint32_t>(bits));
  if (place.kind == FieldPlace::Kind::kFloat) return std::bit_cast<double>(bits);
  switch (number_bytes(place)) {
    case 1:
      return static_cast<std::int8_t>(bits);
    case 2:
      return static_cast<std::int16_t>(bits);
    case 4:
      return static_cast<std::int32_t>(bits);
    default:
      return static_cast<double>(static_cast<std::int64_t>(bits));
  }
}

std::vector<std::uint64_t> extreme_bits(const FieldPlace& place) {
  std::vector<std::uint64_t> bits;
  if (place.kind != FieldPlace::Kind::kFloat) {
    add_integers(place, bits);
  } else if (place.bytes == sizeof(float)) {
    add_floats<float, std::uint32_t>(place.quantity, bits);
  } else {
    add_floats<double, std::uint64_t>(place.quantity, bits);
  }
  return bits;
}

}  // namespace adit
