// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <exception>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <string_view>

#include "common/bus/bus.hpp"
#include "common/bus/dispatcher.hpp"
#include "common/bus/timers.hpp"

namespace lcm {
class LCM;
struct ReceiveBuffer;
}  // namespace lcm

namespace adit {

/// Whose time bus time is: the clock's of this machine, or a simulator's, by SIM_TIME.
enum class BusTime { kWall, kSimulated };

struct LcmBusOptions {
  std::string url;  ///< empty: LCM's default, or what LCM_DEFAULT_URL says
  std::size_t max_message_bytes = Dispatcher::kDefaultMaxMessageBytes;
  BusTime time = BusTime::kWall;
  std::string stage = {};  ///< in whose name SIM_TIME is answered; empty: it is not
};

/// The bus on the robot: LCM between processes, the wall clock for time. A process hears what it
/// publishes itself, too. Messages are taken out of LCM's own queue, which would drop the newest,
/// before each handler runs, and wait in the queues that `subscribe` asked for.
///
/// With simulated time, bus time is the newest SIM_TIME that had its turn: it waits for its turn as
/// other messages do, in order of arrival, so that all that came before it has been handled. Then
/// the timers up to it run, and SIM_TIME_DONE says so to a simulator that waits. Before the first
/// SIM_TIME bus time is 0 and no timer runs.
class LcmBus final : public Bus {
 public:
  /// Throws std::runtime_error, with what to do about it, where there is no LCM on the URL, and as
  /// receive_loss_share does.
  explicit LcmBus(const LcmBusOptions& options = {});
  ~LcmBus() override;
  LcmBus(const LcmBus&) = delete;
  LcmBus& operator=(const LcmBus&) = delete;

  /// Waits for a message or a timer for `timeout_ms` at most, runs the timers that are due and
  /// hands one message to its handler. False if no message came.
  bool handle(int timeout_ms);

  /// Handles messages until `stop_descriptor` can be read from.
  void run(int stop_descriptor);

  void publish(std::string_view channel, std::span<const std::uint8_t> bytes) override;
  SubscriptionId subscribe(std::string_view channel, Delivery delivery, Handler handler) override;
  void create_timer(std::int64_t period_us, TimerHandler handler) override;
  void create_wall_timer(std::int64_t period_us, TimerHandler handler) override;
  [[nodiscard]] std::int64_t now_utime() const override;
  [[nodiscard]] const SubscriptionStats& stats(SubscriptionId id) const override;
  [[nodiscard]] std::int64_t unsent() const override { return unsent_; }
  /// Of what comes, in tests (receive_loss_share): 0 where the kernel refuses to lose any.
  [[nodiscard]] double lost_share() const { return filtered_ ? loss_share_ : 0.0; }

 private:
  bool wait(int timeout_ms, int stop_descriptor);
  void drain_lcm_queue();
  static void on_receive(const lcm::ReceiveBuffer* buffer, const std::string& channel, LcmBus* bus);
  [[nodiscard]] std::int64_t time_to_next_timer_us(std::int64_t timeout_us) const;
  void run_due_timers();
  void subscribe_sim_time();
  void advance_to(std::int64_t utime);

  std::unique_ptr<lcm::LCM> lcm_;
  BusTime time_;
  std::string stage_;
  double loss_share_;  // of what comes, in tests
  bool filtered_ = false;
  std::int64_t simulated_utime_ = 0;
  Dispatcher dispatcher_;
  Timers timers_;
  Timers wall_timers_;  // where bus time is simulated; else `timers_` has them all
  std::set<std::string, std::less<>> channels_;
  std::set<int> sockets_;       // by which LCM receives
  std::exception_ptr failure_;  // must not pass through LCM's C code
  std::int64_t unsent_ = 0;
};

}  // namespace adit
