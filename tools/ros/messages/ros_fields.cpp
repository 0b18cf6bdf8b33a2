// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/ros/messages/ros_fields.hpp"

#include <algorithm>

namespace adit {
namespace {

constexpr std::size_t kEncapsulationBytes = 4;

/// Identifiers of the representation of CDR, the second byte.
enum : std::uint8_t {
  kCdrBigEndian = 0x00,
  kCdrLittleEndian = 0x01,
  kPlainCdr2BigEndian = 0x06,
  kPlainCdr2LittleEndian = 0x07,
};

}  // namespace

RosFields::RosFields(std::span<const std::uint8_t> bytes, std::string_view encoding)
    : bytes_(bytes), ros1_(encoding == "ros1") {
  if (ros1_) return;
  ok_ = encoding == "cdr" && bytes.size() >= kEncapsulationBytes && bytes[0] == 0;
  if (!ok_) return;
  const std::uint8_t form = bytes[1];
  const bool cdr2 = form == kPlainCdr2BigEndian || form == kPlainCdr2LittleEndian;
  ok_ = cdr2 || form == kCdrBigEndian || form == kCdrLittleEndian;
  big_endian_ = form == kCdrBigEndian || form == kPlainCdr2BigEndian;
  if (cdr2) align_max_ = 4;
  bytes_ = bytes.subspan(kEncapsulationBytes);  // alignment counts from here
}

void RosFields::align(std::size_t size) {
  if (ros1_) return;
  const std::size_t unit = std::min(size, align_max_);
  raw((unit - at_ % unit) % unit);
}

std::span<const std::uint8_t> RosFields::raw(std::size_t size) {
  if (size > bytes_.size() - at_) ok_ = false;
  if (!ok_) return {};
  const auto field = bytes_.subspan(at_, size);
  at_ += size;
  return field;
}

void RosFields::copy(std::uint8_t* to, std::size_t size) {
  const auto field = raw(size);
  const bool swapped = big_endian_ != (std::endian::native == std::endian::big);
  for (std::size_t i = 0; i < field.size(); ++i) to[swapped ? size - 1 - i : i] = field[i];
}

std::string RosFields::text() {
  const auto field = raw(u32());
  std::string text(field.begin(), field.end());
  if (!ros1_ && !text.empty() && text.back() == '\0') text.pop_back();
  return text;
}

std::size_t RosFields::count(std::size_t element_bytes) {
  const std::uint32_t count = u32();
  if (count > (bytes_.size() - at_) / element_bytes) ok_ = false;
  return ok_ ? count : 0;
}

std::vector<float> RosFields::floats() {
  std::vector<float> values(count(sizeof(float)));
  if (!values.empty()) align(sizeof(float));
  for (float& value : values) value = take<float>();
  return values;
}

std::span<const std::uint8_t> RosFields::bytes() { return raw(count(1)); }

void RosFields::skip_f64(std::size_t elements) {
  align(sizeof(double));
  raw(elements * sizeof(double));
}

RosFields::Header RosFields::header() {
  if (ros1_) u32();  // seq
  const std::int64_t seconds = ros1_ ? static_cast<std::int64_t>(u32()) : i32();
  const std::uint32_t nanoseconds = u32();
  return {seconds * 1'000'000 + nanoseconds / 1000, frame_name(text())};
}

std::string frame_name(std::string_view name) {
  return std::string(name.starts_with('/') ? name.substr(1) : name);
}

}  // namespace adit
