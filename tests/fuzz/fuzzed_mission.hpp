// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/bus/memory_bus.hpp"
#include "common/bus/node/node_host.hpp"
#include "common/messages/diagnostics.hpp"
#include "sim/live/sim_config.hpp"
#include "sim/sim_node.hpp"
#include "sim/world/build_world.hpp"
#include "tests/fuzz/mutator.hpp"
#include "tests/support/message_types.hpp"

namespace adit::fuzz {

/// What happened to the mutated messages of one channel.
struct ChannelCounts {
  std::int64_t sent = 0;
  std::int64_t subscriptions = 0;  ///< of the stages to the channel
  std::int64_t rejected = 0;       ///< summed over these subscriptions
  double max_ms = 0.0;             ///< longest time of one message, with all that follows from it
};

/// A mission in a simulated tunnel, all stages in this process, which receives mutated messages
/// amid its own, some of them just before the message that they resemble: each is a message of the
/// mission in which one field, seldom two, has an extreme value or random bits, or whose bytes are
/// damaged. Deterministic for a seed.
class FuzzedMission {
 public:
  /// Journals are written to `folder`. `alive` is called before each message and each step.
  FuzzedMission(const Site& site, const std::filesystem::path& folder, std::uint64_t seed,
                std::function<void()> alive);

  /// Advances the simulation, and sends messages. Returns how many.
  std::int64_t step();

  /// Advances the simulation without mutated messages until every stage works, from two to twelve
  /// seconds: a time stamp in the future delays later ones. Returns what does not work then, one
  /// clause each.
  std::vector<std::string> recover();

  /// Commands of the stages beyond the limits of the vehicle, exceptions of handlers, and a
  /// collision, one clause each.
  [[nodiscard]] std::vector<std::string> failures() const;

  /// Whether the mission has ended, after which nothing happens anymore.
  [[nodiscard]] bool is_over() const;

  /// By channel.
  [[nodiscard]] std::map<std::string, ChannelCounts, std::less<>> counts() const;

 private:
  /// The newest message of a channel that can be mutated, with the places of its fields.
  struct Sample {
    const MessageType* type = nullptr;
    Bytes bytes;
    std::map<std::string, std::vector<FieldPlace>> fields;  ///< by name
    std::int64_t uses = 0;
    bool is_current = false;  ///< whether its time stays that of the message that it precedes
  };

  void set_sample(const MessageType& type, std::span<const std::uint8_t> bytes, Sample& sample);
  void observe(const ReceivedMessage& message);
  void observe_heartbeat(std::span<const std::uint8_t> bytes);
  void observe_phase(std::span<const std::uint8_t> bytes);
  void check_command(std::span<const std::uint8_t> bytes);
  void advance();
  [[nodiscard]] std::vector<std::string> missing_output() const;
  void find_subscribed();
  void send_burst();
  void send_before(const ReceivedMessage& message, const MessageType& type);
  void send(const std::string& channel, Sample& sample);
  void change_field(const Sample& sample, Bytes& bytes);
  [[nodiscard]] Bytes mutated(const Sample& sample);
  [[nodiscard]] std::size_t below(std::size_t end);

  std::function<void()> alive_;
  std::vector<MessageType> types_;
  std::map<std::int64_t, const MessageType*> by_fingerprint_;
  SimulationParams params_;
  MemoryBus bus_;
  NodeHost sim_host_;
  SimNode sim_;
  std::vector<std::string> stages_;
  std::vector<std::unique_ptr<HostedNode>> nodes_;
  Mutator mutator_;
  std::map<std::string, Sample, std::less<>> samples_;            ///< by channel
  std::vector<std::string> subscribed_;                           ///< channels
  std::map<std::string, std::int64_t, std::less<>> last_utime_;   ///< of output, by channel
  std::map<std::string, Heartbeat, std::less<>> last_heartbeat_;  ///< by stage
  std::map<std::string, ChannelCounts, std::less<>> counts_;
  std::vector<std::string> bad_commands_;
  std::int64_t sent_ = 0;
  bool sends_ = false;
  bool injecting_ = false;
  bool has_ended_ = false;
};

}  // namespace adit::fuzz
