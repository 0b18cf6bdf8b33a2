// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/cloud/number_type.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

namespace adit {
namespace {

using Kind = NumberType::Kind;

constexpr std::array<std::pair<std::string_view, NumberType>, 16> kPlyTypes{
    {{"char", {Kind::kSigned, 1}},
     {"int8", {Kind::kSigned, 1}},
     {"uchar", {Kind::kUnsigned, 1}},
     {"uint8", {Kind::kUnsigned, 1}},
     {"short", {Kind::kSigned, 2}},
     {"int16", {Kind::kSigned, 2}},
     {"ushort", {Kind::kUnsigned, 2}},
     {"uint16", {Kind::kUnsigned, 2}},
     {"int", {Kind::kSigned, 4}},
     {"int32", {Kind::kSigned, 4}},
     {"uint", {Kind::kUnsigned, 4}},
     {"uint32", {Kind::kUnsigned, 4}},
     {"float", {Kind::kFloat, 4}},
     {"float32", {Kind::kFloat, 4}},
     {"double", {Kind::kFloat, 8}},
     {"float64", {Kind::kFloat, 8}}}};

std::uint64_t bits(const std::uint8_t* at, std::size_t bytes, bool big_endian) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < bytes; ++i) {
    value = value << 8U | at[big_endian ? i : bytes - 1 - i];
  }
  return value;
}

/// Sign extension of an integer of `bytes` bytes.
std::int64_t sign_extended(std::uint64_t value, std::size_t bytes) {
  const auto shift = static_cast<unsigned>(64 - 8 * bytes);
  return static_cast<std::int64_t>(value << shift) >> shift;
}

}  // namespace

double NumberType::read(const std::uint8_t* at, bool big_endian) const {
  const std::uint64_t value = bits(at, bytes, big_endian);
  if (kind == Kind::kUnsigned) return static_cast<double>(value);
  if (kind == Kind::kSigned) return static_cast<double>(sign_extended(value, bytes));
  if (bytes == 8) return std::bit_cast<double>(value);
  return std::bit_cast<float>(static_cast<std::uint32_t>(value));
}

std::optional<NumberType> ply_type(std::string_view name) {
  const auto* const found = std::find_if(kPlyTypes.begin(), kPlyTypes.end(),
                                         [&](const auto& entry) { return entry.first == name; });
  if (found == kPlyTypes.end()) return std::nullopt;
  return found->second;
}

std::optional<NumberType> pcd_type(std::string_view letter, std::size_t bytes) {
  if (letter == "F" && (bytes == 4 || bytes == 8)) return NumberType{Kind::kFloat, bytes};
  if (bytes != 1 && bytes != 2 && bytes != 4 && bytes != 8) return std::nullopt;
  if (letter == "I") return NumberType{Kind::kSigned, bytes};
  if (letter == "U") return NumberType{Kind::kUnsigned, bytes};
  return std::nullopt;
}

}  // namespace adit
