// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/clocks/clock_fault_bus.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace adit::test {
namespace {

constexpr std::size_t kStampAt = 8;  // behind the fingerprint of LCM
constexpr std::size_t kStampBytes = 8;

/// Big-endian, as LCM encodes.
std::int64_t stamp_of(std::span<const std::uint8_t> bytes) {
  std::uint64_t value = 0;
  for (const std::uint8_t byte : bytes.subspan(kStampAt, kStampBytes)) value = value << 8U | byte;
  return static_cast<std::int64_t>(value);
}

void set_stamp(std::vector<std::uint8_t>& bytes, std::int64_t utime) {
  auto value = static_cast<std::uint64_t>(utime);
  for (std::size_t i = kStampAt + kStampBytes; i-- > kStampAt; value >>= 8U) {
    bytes[i] = static_cast<std::uint8_t>(value & 0xffU);
  }
}

}  // namespace

std::string ClockFault::text() const {
  if (kind == Kind::kNone) return "none";
  std::string text = fmt::format("{} ", fmt::join(channels, ", "));
  if (kind == Kind::kJump) text += fmt::format("{:+g} s", amount);
  if (kind == Kind::kDrift) text += fmt::format("{:+g} ppm", amount);
  if (kind == Kind::kFrozen) text += "frozen";
  if (duration_s == 0.0) return text + " once";
  return text + (duration_s >= kForGood ? " for good" : fmt::format(" for {:g} s", duration_s));
}

ClockFaultBus::ClockFaultBus(Bus& bus, ClockFault fault, std::int64_t start_utime)
    : ForwardingBus(bus), fault_(std::move(fault)), start_utime_(start_utime) {
  for (const std::string& channel : fault_.channels) channels_.push_back({channel});
}

double ClockFaultBus::now_s() const {
  return 1e-6 * static_cast<double>(now_utime() - start_utime_);
}

bool ClockFaultBus::is_active(const Channel& channel) const {
  if (fault_.kind == ClockFault::Kind::kNone || now_s() < fault_.at_s) return false;
  if (fault_.duration_s == 0.0) return !channel.has_failed;
  return now_s() < fault_.at_s + fault_.duration_s;
}

std::int64_t ClockFaultBus::faulty_utime(const Channel& channel, std::int64_t utime) const {
  switch (fault_.kind) {
    case ClockFault::Kind::kNone:
      return utime;
    case ClockFault::Kind::kJump:
      return utime + std::llround(1e6 * fault_.amount);
    case ClockFault::Kind::kDrift:
      return utime + std::llround(fault_.amount * (now_s() - fault_.at_s));
    case ClockFault::Kind::kFrozen:
      return channel.last_utime == 0 ? utime : channel.last_utime;
  }
  return utime;
}

void ClockFaultBus::publish(std::string_view channel, std::span<const std::uint8_t> bytes) {
  const auto found = std::ranges::find(channels_, channel, &Channel::name);
  if (found == channels_.end()) return ForwardingBus::publish(channel, bytes);
  if (!is_active(*found)) {
    if (!found->has_failed) found->last_utime = stamp_of(bytes);
    return ForwardingBus::publish(channel, bytes);
  }
  std::vector<std::uint8_t> stamped(bytes.begin(), bytes.end());
  set_stamp(stamped, faulty_utime(*found, stamp_of(bytes)));
  found->has_failed = true;
  ++changed_;
  ForwardingBus::publish(channel, stamped);
}

std::optional<double> ClockFaultBus::ended_s() const {
  const bool all_failed = std::ranges::all_of(channels_, &Channel::has_failed);
  const double end_s = fault_.at_s + fault_.duration_s;
  if (channels_.empty() || !all_failed || now_s() < end_s) return std::nullopt;
  return end_s;
}

}  // namespace adit::test
