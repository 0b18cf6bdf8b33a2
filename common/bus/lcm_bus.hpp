// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/bus/bus.hpp"
#include "common/bus/dispatcher.hpp"
#include "common/bus/order_seal.hpp"
#include "common/bus/timers.hpp"

namespace lcm {
class LCM;
struct ReceiveBuffer;
}  // namespace lcm

namespace adit {

/// The source of bus time: the wall clock of this computer, or a simulator (SIM_TIME).
enum class BusTime { kWall, kSimulated };

struct LcmBusOptions {
  std::string url;  ///< empty: LCM_DEFAULT_URL, or LCM's default
  std::size_t max_message_bytes = Dispatcher::kDefaultMaxMessageBytes;
  BusTime time = BusTime::kWall;
  std::string stage = {};  ///< name in SIM_TIME_DONE; empty: SIM_TIME is not acknowledged
  std::optional<SealKey> seal =
      {};  ///< key of orders; nothing: they are neither sealed nor checked
};

/// The bus on the robot: LCM between processes, bus time from the wall clock. A process also
/// receives its own messages. Before each handler runs, all messages are moved from LCM's queue,
/// which drops the newest when full, into the queues requested by `subscribe`.
///
/// With simulated time, bus time is that of the last handled SIM_TIME. SIM_TIME is queued with all
/// other messages in order of arrival, so that every message received before it has been handled.
/// Then the timers that are due run, and SIM_TIME_DONE acknowledges the time to the simulator.
/// Before the first SIM_TIME, bus time is 0 and no timer runs.
///
/// With a key, orders are sealed and checked as they arrive, before they can displace others in a
/// queue; see OrderSeal. A bus that subscribes to orders challenges their senders.
class LcmBus final : public Bus {
 public:
  /// Throws std::runtime_error, with advice, if LCM cannot be opened on the URL.
  explicit LcmBus(const LcmBusOptions& options = {});
  ~LcmBus() override;
  LcmBus(const LcmBus&) = delete;
  LcmBus& operator=(const LcmBus&) = delete;

  /// Waits up to `timeout_ms` for a message or a timer, runs the due timers and handles one
  /// message. Returns false if no message was handled.
  bool handle(int timeout_ms);

  /// Handles messages until `stop_descriptor` becomes readable.
  void run(int stop_descriptor);

  void publish(std::string_view channel, std::span<const std::uint8_t> bytes) override;
  SubscriptionId subscribe(std::string_view channel, Delivery delivery, Handler handler) override;
  void create_timer(std::int64_t period_us, TimerHandler handler) override;
  void create_wall_timer(std::int64_t period_us, TimerHandler handler) override;
  void watch(int descriptor, std::function<void()> handler) override;
  [[nodiscard]] std::int64_t now_utime() const override;
  [[nodiscard]] const SubscriptionStats& stats(SubscriptionId id) const override;
  [[nodiscard]] std::int64_t unsent() const override { return unsent_; }
  [[nodiscard]] std::int64_t without_valid_seal() const override;

 private:
  bool wait(int timeout_ms, int stop_descriptor);
  void drain_lcm_queue();
  static void on_receive(const lcm::ReceiveBuffer* buffer, const std::string& channel, LcmBus* bus);
  [[nodiscard]] std::int64_t time_to_next_timer_us(std::int64_t timeout_us) const;
  void run_due_timers();
  void receive(const ReceivedMessage& received);
  void subscribe_sim_time();
  void subscribe_seal();
  void publish_seal(std::string_view channel, const SealNonce& nonce);
  void challenge_senders();
  void advance_to(std::int64_t utime);

  std::unique_ptr<lcm::LCM> lcm_;
  BusTime time_;
  std::string stage_;
  std::int64_t simulated_utime_ = 0;
  Dispatcher dispatcher_;
  Timers timers_;
  std::vector<std::pair<int, std::function<void()>>> watched_;  // descriptors of devices
  Timers wall_timers_;  // with simulated time only; otherwise `timers_` has all timers
  std::set<std::string, std::less<>> channels_;
  std::set<int> sockets_;  // on which LCM receives
  std::optional<OrderSeal> seal_;
  bool receives_orders_ = false;
  std::exception_ptr failure_;  // of a callback; must not propagate through LCM's C code
  std::int64_t unsent_ = 0;
};

}  // namespace adit
