// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/scip/response.hpp"

#include <cmath>
#include <utility>

namespace adit {
namespace {

constexpr int kBits = 6;
constexpr char kZero = 0x30;
constexpr unsigned kMask = 0x3F;
constexpr std::size_t kLineMax = 130;        // more than any line of data or parameters
constexpr std::size_t kResponseMax = 40000;  // more than 4,096 beams with intensities

}  // namespace

char scip_checksum(std::string_view line) {
  unsigned sum = 0;
  for (const char c : line) sum += static_cast<unsigned char>(c);
  return static_cast<char>((sum & kMask) + kZero);
}

std::optional<std::uint32_t> scip_number(std::string_view characters) {
  std::uint32_t number = 0;
  for (const char c : characters) {
    const int value = c - kZero;
    if (value < 0 || value > static_cast<int>(kMask)) return std::nullopt;
    number = number << kBits | static_cast<std::uint32_t>(value);
  }
  return number;
}

void ScipDecoder::clear() {
  counts_.garbage_bytes += static_cast<std::int64_t>(bytes_);
  line_.clear();
  lines_.clear();
  bytes_ = 0;
}

/// Parameters have their checksum behind a semicolon, which it does not include.
std::optional<ScipResponse> ScipDecoder::response_of(std::vector<std::string> lines) const {
  if (lines.size() < 2) return std::nullopt;
  ScipResponse response;
  response.echo = std::move(lines[0]);
  for (std::size_t i = 1; i < lines.size(); ++i) {
    std::string& line = lines[i];
    const char sum = line.back();
    line.pop_back();
    if (i > 1 && line.ends_with(';') && scip_checksum(line) != sum) line.pop_back();
    if (scip_checksum(line) != sum) return std::nullopt;
    if (i == 1) {
      response.status = std::move(line);
    } else {
      response.lines.push_back(std::move(line));
    }
  }
  if (response.status.size() != 2) return std::nullopt;
  return response;
}

void ScipDecoder::add(std::span<const std::uint8_t> bytes, std::int64_t arrival_us,
                      double byte_us) {
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    ++bytes_;
    if (bytes[i] != '\n') {
      line_ += static_cast<char>(bytes[i]);
      if (line_.size() > kLineMax || bytes_ > kResponseMax) clear();
      continue;
    }
    if (!line_.empty()) {
      lines_.push_back(std::exchange(line_, {}));
      continue;
    }
    if (auto response = response_of(std::exchange(lines_, {}))) {
      response->bytes = bytes_;
      const auto behind = static_cast<double>(bytes.size() - i - 1);
      response->end_us = arrival_us - std::llround(behind * byte_us);
      responses_.push_back(std::move(*response));
      ++counts_.responses;
    } else {
      if (bytes_ > 1) ++counts_.corrupt;
      counts_.garbage_bytes += static_cast<std::int64_t>(bytes_);
    }
    bytes_ = 0;
  }
}

std::optional<ScipResponse> ScipDecoder::next() {
  if (returned_ == responses_.size()) {
    responses_.clear();
    returned_ = 0;
    return std::nullopt;
  }
  return std::move(responses_[returned_++]);
}

}  // namespace adit
