// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace adit {

/// True for a valid channel name: 1 to 63 (LCM_MAX_CHANNEL_NAME_LENGTH) characters of A-Z 0-9 _.
inline bool is_channel_name(std::string_view name) {
  constexpr std::size_t kLengthMax = 63;
  return !name.empty() && name.size() <= kLengthMax &&
         std::all_of(name.begin(), name.end(), [](char c) {
           return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
         });
}

/// A received message with its bus time of arrival [µs since the epoch].
struct ReceivedMessage {
  std::string_view channel;
  std::int64_t utime = 0;
  std::span<const std::uint8_t> bytes;
};

/// Handles a message. Returns the reason for rejection, a text of static storage, or an empty text.
using Handler = std::function<std::string_view(const ReceivedMessage&)>;

/// Called with bus time [µs since the epoch].
using TimerHandler = std::function<void(std::int64_t utime)>;

/// Queue policy of a subscription whose handler is slower than its channel: only the newest message
/// (for state), or the newest `capacity` messages (for measurements); the oldest are dropped.
struct Delivery {
  std::size_t capacity = 1;
  bool counts_drops = false;  ///< whether a message replaced by a newer one counts as a loss

  static Delivery latest() { return {1, false}; }
  static Delivery queued(std::size_t capacity) { return {capacity, true}; }
};

/// Identifies a subscription of a bus; returned by `subscribe`.
using SubscriptionId = std::size_t;

/// Message counts of one subscription since it was made.
struct SubscriptionStats {
  std::string channel;
  std::int64_t handled = 0;
  std::int64_t rejected = 0;
  std::int64_t dropped = 0;
  std::map<std::string, std::int64_t, std::less<>> rejections;  ///< rejected messages by reason
};

/// Carries messages between stages. Single-threaded: handlers run one at a time, on the thread that
/// drives the bus, never inside `publish`. An exception thrown by a handler propagates to the
/// caller that drives the bus.
///
/// Bus time is the wall clock on the robot (LcmBus), simulated time with a simulator, and the time
/// of the messages in a replay or a test (ReplayBus, MemoryBus): the same inputs then give the same
/// outputs.
///
/// A channel name has 1 to 63 characters of A–Z, 0–9 and _; any other name throws
/// std::invalid_argument.
class Bus {
 public:
  virtual ~Bus() = default;

  virtual void publish(std::string_view channel, std::span<const std::uint8_t> bytes) = 0;

  /// The handler must outlive every call that drives the bus.
  virtual SubscriptionId subscribe(std::string_view channel, Delivery delivery,
                                   Handler handler) = 0;

  /// Calls the handler when bus time is first known and then once per period [µs]. A replay makes
  /// up for the ticks of a gap of at most ten seconds.
  virtual void create_timer(std::int64_t period_us, TimerHandler handler) = 0;

  /// The same by wall time, even where bus time is simulated: for the supervision of processes and
  /// devices, not for computations on messages. A replay or a test has no wall time; the timer then
  /// runs on bus time.
  virtual void create_wall_timer(std::int64_t period_us, TimerHandler handler) {
    create_timer(period_us, std::move(handler));
  }

  /// Calls the handler whenever this descriptor of a device is readable, while the bus lives. A
  /// replay or a test has no devices and never calls it.
  // NOLINTNEXTLINE(performance-unnecessary-value-param): implementations keep it
  virtual void watch(int /*descriptor*/, std::function<void()> /*handler*/) {}

  /// Bus time [µs since the epoch].
  [[nodiscard]] virtual std::int64_t now_utime() const = 0;

  [[nodiscard]] virtual const SubscriptionStats& stats(SubscriptionId id) const = 0;

  /// Number of messages that the transport failed to send.
  [[nodiscard]] virtual std::int64_t unsent() const { return 0; }

  /// Number of orders that were rejected because no valid seal was on them.
  [[nodiscard]] virtual std::int64_t without_valid_seal() const { return 0; }
};

/// Throws std::invalid_argument unless the channel name is valid.
void require_valid_channel(std::string_view channel);

}  // namespace adit
