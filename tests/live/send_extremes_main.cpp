// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// send_extremes SECONDS: listens to the stages of a mission for so long, then sends messages of
// every type with one field changed: each field to the ends of its type and its quantity,
// denormals, infinities, NaN and random bits. Then every stage must have a heartbeat again, POSE
// and STOP must continue, and the simulated vehicle must not have failed. Valid orders are left
// out.
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <iostream>
#include <map>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>

#include "common/bus/channels.hpp"
#include "common/bus/lcm_bus.hpp"
#include "common/messages/codec.hpp"
#include "common/messages/diagnostics.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/sim.hpp"
#include "tests/fuzz/mutator.hpp"
#include "tests/live/checks/log_check.hpp"
#include "tests/support/message_fields.hpp"
#include "tests/support/message_types.hpp"

namespace adit {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::seconds;

constexpr seconds kAfter{5};
constexpr std::chrono::microseconds kBetweenMessages{500};
constexpr int kRandomPerField = 6;
constexpr std::array kOrders{channels::kMissionOrder,    channels::kPmOrders,
                             channels::kScanRequest,     channels::kTiltCommandFront,
                             channels::kTiltCommandRear, channels::kDriveCommand};
constexpr std::array kStages{"scan_matching", "mapping",  "scan_assembly", "terrain",
                             "volume_map",    "planning", "driving",       "guard",
                             "exploration",   "mission"};

Requirements require;

class Sender {
 public:
  explicit Sender(const std::vector<MessageType>& types) : types_(types) {
    for (const MessageType& type : types_) {
      samples_[type.channel] = {&type, type.sample, Clock::now()};
      bus_.subscribe(type.channel, Delivery::queued(1000),
                     [this, &type](const ReceivedMessage& received) -> std::string_view {
                       observe(type, received);
                       return {};
                     });
    }
  }

  void listen(seconds duration) {
    const auto end = Clock::now() + duration;
    while (Clock::now() < end) bus_.handle(10);
  }

  /// Returns the number of messages.
  int send_all() {
    keeps_samples_ = true;
    int sent = 0;
    for (auto& [channel, sample] : samples_) {
      const FieldLayout layout = sample.type->layout(sample.bytes);
      std::map<std::string, FieldPlace> places;  // the last of each array
      for (const FieldPlace& place : layout.places()) places[place.name] = place;
      for (const auto& [name, place] : places) sent += send(channel, sample, place, layout);
    }
    return sent;
  }

  void forget() {
    heartbeats_.clear();
    received_.clear();
  }

  void check() const {
    for (const char* stage : kStages)
      require(heartbeats_.contains(stage), fmt::format("{} has a heartbeat", stage));
    for (const std::string_view channel :
         {channels::kPose, channels::kStop, channels::kVehicleState})
      require(received_.contains(std::string(channel)), fmt::format("{} continues", channel));
    require(failure_.empty(), "the vehicle works: " + failure_);
  }

 private:
  struct Sample {
    const MessageType* type = nullptr;
    std::vector<std::uint8_t> bytes;
    Clock::time_point received;
  };

  void observe(const MessageType& type, const ReceivedMessage& received) {
    received_.insert(type.channel);
    if (type.channel == channels::kHeartbeat) {
      if (const auto heartbeat = decode<heartbeat_t>(received.bytes))
        heartbeats_.insert(heartbeat->stage);
    }
    if (type.channel == channels::kRunState) {
      if (const auto state = decode<run_state_t>(received.bytes); state) failure_ = state->failure;
    }
    if (keeps_samples_ || !type.process(received.bytes).empty()) return;
    samples_[type.channel] = {&type, {received.bytes.begin(), received.bytes.end()}, Clock::now()};
  }

  /// The sample with the time of now, which is the first field of every type.
  static std::vector<std::uint8_t> as_of_now(const Sample& sample) {
    static const FieldPlace kUtime{"utime", FieldPlace::Kind::kInteger, sizeof(std::int64_t),
                                   sizeof(std::int64_t)};
    std::vector<std::uint8_t> message = sample.bytes;
    const auto elapsed =
        std::chrono::duration_cast<std::chrono::microseconds>(Clock::now() - sample.received);
    write_bits(kUtime, read_bits(message, kUtime) + static_cast<std::uint64_t>(elapsed.count()),
               message);
    return message;
  }

  /// Sends a scan of the same time, without which mapping does not use a match, and makes it a lost
  /// one, of which the covariance counts.
  void prepare_match(const FieldLayout& layout, std::vector<std::uint8_t>& match) {
    std::vector<std::uint8_t> scan = as_of_now(samples_.at(std::string(channels::kLaserFront)));
    std::copy_n(match.begin() + sizeof(std::int64_t), sizeof(std::int64_t),
                scan.begin() + sizeof(std::int64_t));
    bus_.publish(channels::kLaserFront, scan);
    for (const FieldPlace& status : layout.places()) {
      if (status.name == "status") write_bits(status, scan_match_t::STATUS_LOST, match);
    }
  }

  int send(const std::string& channel, const Sample& sample, const FieldPlace& place,
           const FieldLayout& layout) {
    const bool is_order = std::ranges::find(kOrders, channel) != kOrders.end();
    std::vector<std::uint64_t> all = extreme_bits(place);
    for (int i = 0; i < kRandomPerField; ++i) all.push_back(random_.random());
    int sent = 0;
    for (const std::uint64_t bits : all) {
      std::vector<std::uint8_t> message = as_of_now(sample);
      if (channel == channels::kScanMatch) prepare_match(layout, message);
      write_bits(place, bits, message);
      if (is_order && sample.type->process(message).empty()) continue;
      bus_.publish(channel, message);
      ++sent;
      std::this_thread::sleep_for(kBetweenMessages);
      while (bus_.handle(0)) {
      }
    }
    return sent;
  }

  const std::vector<MessageType>& types_;
  LcmBus bus_;
  fuzz::Mutator random_{1};
  std::map<std::string, Sample> samples_;  // by channel
  std::set<std::string> received_;         // channels
  std::set<std::string> heartbeats_;       // stages
  std::string failure_;
  bool keeps_samples_ = false;
};

int run(int listen_s) {
  const std::vector<MessageType> types = message_types();
  Sender sender(types);
  sender.listen(seconds(listen_s));
  sender.check();  // the mission runs
  if (!require.all_met()) return require.exit_code();
  const auto start = Clock::now();
  const int sent = sender.send_all();
  const std::chrono::duration<double> taken = Clock::now() - start;
  std::cout << fmt::format("{} messages in {:.1f} s\n", sent, taken.count());
  sender.forget();
  sender.listen(kAfter);
  sender.check();
  require(sent > 9'000, "all fields were changed");
  return require.exit_code();
}

}  // namespace
}  // namespace adit

int main(int argc, char** argv) try {
  if (argc != 2) {
    std::cerr << "send_extremes SECONDS\n";
    return 2;
  }
  return adit::run(std::stoi(argv[1]));
} catch (const std::exception& error) {
  std::cerr << "send_extremes: " << error.what() << "\n";
  return 2;
}
