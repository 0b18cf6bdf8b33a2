// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/sick_lms2xx/measured_values.hpp"

#include <limits>

namespace adit {
namespace {

constexpr std::size_t kHeaderBytes = 2;
constexpr std::size_t kStatusBytes = 1;
constexpr std::size_t kIndexBytesMax =
    2;  // of the scan and of the telegram, if the laser is set so
constexpr unsigned kDistanceBits = 0x1FFF;
constexpr std::uint16_t kNoReturn = 0x1FFF;

unsigned word(std::span<const std::uint8_t> data, std::size_t at) {
  return data[at] + 256U * data[at + 1];
}

}  // namespace

std::vector<float> LmsMeasuredValues::ranges_m() const {
  std::vector<float> ranges;
  ranges.reserve(raw.size());
  for (const std::uint16_t value : raw) {
    if (value == kDazzled || value == kReadError) {
      ranges.push_back(std::numeric_limits<float>::quiet_NaN());
    } else {
      ranges.push_back(static_cast<float>((value >= kCodesFrom ? kNoReturn : value) * unit_m));
    }
  }
  return ranges;
}

Result<LmsMeasuredValues> read_measured_values(std::span<const std::uint8_t> data) {
  if (data.size() < kHeaderBytes + kStatusBytes)
    return Rejected{"measured values without a number"};
  const unsigned header = word(data, 0);
  const std::size_t count = header & 0x3FFU;
  const unsigned unit = header >> 14;
  if (unit > 1) return Rejected{"measured values in an unknown unit"};
  if ((header >> 11 & 0x7U) != 0) return Rejected{"measured values of a part of a scan"};
  const std::size_t least = kHeaderBytes + 2 * count + kStatusBytes;
  if (count == 0 || data.size() < least || data.size() > least + kIndexBytesMax) {
    return Rejected{"measured values of another length than their number says"};
  }
  LmsMeasuredValues values{unit == 0 ? 0.01 : 0.001, {}};
  values.raw.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const unsigned value = word(data, kHeaderBytes + 2 * i) & kDistanceBits;
    values.raw.push_back(static_cast<std::uint16_t>(value));
  }
  return values;
}

}  // namespace adit
