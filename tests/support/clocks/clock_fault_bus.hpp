// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/bus/forwarding_bus.hpp"

namespace adit::test {

/// A fault of the clock that stamps the measurements of some channels.
struct ClockFault {
  enum class Kind {
    kNone,
    kJump,    ///< stamps are off by `amount` [s]
    kDrift,   ///< stamps run fast by `amount` [ppm], and jump back at the end
    kFrozen,  ///< all stamps are the last one before the fault
  };

  Kind kind = Kind::kNone;
  std::vector<std::string> channels;
  double amount = 0.0;
  double at_s = 0.0;        ///< begin, since the start of the run
  double duration_s = 0.0;  ///< 0: one message of each channel; kForGood: it never ends

  static constexpr double kForGood = 1e9;

  /// "LASER_FRONT +0.6 s for 15 s"
  [[nodiscard]] std::string text() const;
};

/// Fault injection: a bus between drivers and stages that changes the time stamps of what is
/// published on some channels; its arrival is unchanged. Forwards everything else. Of a message
/// only the bytes of the stamp change: by the conventions of lcmtypes it is the first field.
class ClockFaultBus final : public ForwardingBus {
 public:
  /// `bus` must outlive this. `start_utime`: bus time at the start of the run.
  ClockFaultBus(Bus& bus, ClockFault fault, std::int64_t start_utime);

  void publish(std::string_view channel, std::span<const std::uint8_t> bytes) override;

  /// Messages whose stamp was changed.
  [[nodiscard]] std::int64_t changed() const { return changed_; }
  /// Time since the start at which the fault ended, once it has [s].
  [[nodiscard]] std::optional<double> ended_s() const;

 private:
  struct Channel {
    std::string name;
    std::int64_t last_utime = 0;  ///< of the last stamp before the fault
    bool has_failed = false;
  };

  [[nodiscard]] double now_s() const;
  [[nodiscard]] bool is_active(const Channel& channel) const;
  [[nodiscard]] std::int64_t faulty_utime(const Channel& channel, std::int64_t utime) const;

  ClockFault fault_;
  std::int64_t start_utime_;
  std::vector<Channel> channels_;
  std::int64_t changed_ = 0;
};

}  // namespace adit::test
