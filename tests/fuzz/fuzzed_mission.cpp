// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fuzz/fuzzed_mission.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <iterator>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "common/bus/channels.hpp"
#include "common/bus/node/stages.hpp"
#include "common/config/config_file.hpp"
#include "common/messages/codec.hpp"
#include "common/messages/diagnostics.hpp"
#include "common/messages/mission.hpp"
#include "common/messages/navigation.hpp"
#include "common/sensing/seconds.hpp"
#include "tools/mission/pipeline.hpp"

namespace adit::fuzz {
namespace {

constexpr std::int64_t kStartUtime = 1'600'000'000'000'000;
constexpr std::size_t kBurstOneIn = 2;    // steps
constexpr int kBurstLength = 64;          // messages
constexpr int kLongBurstLength = 2;       // of messages that take a stage long
constexpr std::size_t kBeforeOneIn = 8;   // messages of the mission
constexpr int kCopies = 4;                // sent before one of them
constexpr std::size_t kCopiedMax = 4000;  // [bytes]
constexpr std::size_t kSecondFieldOneIn = 8;
constexpr std::int64_t kSampleUses = 200;  // mutations of a sample before the next one
constexpr std::size_t kFieldsOneIn = 4;    // all but one in so many mutate a field, the rest bytes
constexpr std::int64_t kRecoveryUs = 2'000'000;
constexpr std::int64_t kRecoveryMaxUs = 12'000'000;
constexpr double kAgeMaxS = 1.5;  // of an output that is periodic
constexpr double kTolerance = 1e-9;

/// A wild pose makes the map of exploration as large as its limit allows, which takes a stage long;
/// the mines are smaller than 100 m.
constexpr const char* kConfig = "exploration: {known: {cells_max: 1000000}}";

/// What the stages publish periodically, whatever the mission does.
constexpr std::array kPeriodic{channels::kPose, channels::kScanMatch, channels::kStop,
                               channels::kPhase};

/// Each starts a search for a path, or a map of a 3D scan.
constexpr std::array kLong{channels::kGoal, channels::kTerrainReady, channels::kCloud,
                           channels::kCloudResend};

/// Orders, which end the mission, are rare.
constexpr std::size_t kOrderOneIn = 500;

}  // namespace

FuzzedMission::FuzzedMission(const Site& site, const std::filesystem::path& folder,
                             std::uint64_t seed, std::function<void()> alive)
    : alive_(std::move(alive)),
      types_(message_types()),
      params_(load_simulation_params({}, {})),
      sim_host_(bus_, {kSimSection, "", ""}),
      sim_(sim_host_.bus(), site, params_, seed, kStartUtime),
      mutator_(seed) {
  for (const MessageType& type : types_) {
    by_fingerprint_[type.fingerprint] = &type;
    set_sample(type, type.sample, samples_[type.channel]);
    samples_[type.channel].uses = kSampleUses;
  }
  bus_.tap([this](const ReceivedMessage& message) { observe(message); });
  for (const ConfiguredNode& node : configure_pipeline(ConfigFile::parse(kConfig, "fuzzed"),
                                                       params_.lasers, params_.vehicle, folder)) {
    stages_.push_back(node.stage);
    nodes_.push_back(std::make_unique<HostedNode>(bus_, node));
  }
  find_subscribed();
}

/// The channels of a known type that a stage subscribes to. Not the tilt commands, which the
/// simulated actuators obey: with both lasers tilted there is no pose.
void FuzzedMission::find_subscribed() {
  // Those with more than one channel.
  const std::array more{std::pair(channels::kLaserFront, channels::kLaserRear),
                        std::pair(channels::kTiltFront, channels::kTiltRear)};
  for (const auto& [channel, other] : more)
    samples_[std::string(other)] = samples_.at(std::string(channel));
  std::set<std::string> channels;
  const auto add = [&channels](const std::vector<SubscriptionStats>& all) {
    for (const SubscriptionStats& stats : all) channels.insert(stats.channel);
  };
  for (const auto& node : nodes_) add(node->subscription_stats());
  for (const std::string& channel : channels) {
    if (samples_.contains(channel)) subscribed_.push_back(channel);
  }
}

std::size_t FuzzedMission::below(std::size_t end) { return mutator_.below(end); }

void FuzzedMission::set_sample(const MessageType& type, std::span<const std::uint8_t> bytes,
                               Sample& sample) {
  sample = {&type, {bytes.begin(), bytes.end()}, {}, 0};
  const FieldLayout layout = type.layout(bytes);
  for (const FieldPlace& place : layout.places()) sample.fields[place.name].push_back(place);
}

/// Keeps a sample of each channel, renewed when it is used up, and the time of each output.
void FuzzedMission::observe(const ReceivedMessage& message) {
  if (std::exchange(injecting_, false)) return;
  last_utime_[std::string(message.channel)] = message.utime;
  if (message.channel == channels::kHeartbeat) observe_heartbeat(message.bytes);
  if (message.channel == channels::kPhase) observe_phase(message.bytes);
  if (message.channel == channels::kDriveCommand) check_command(message.bytes);
  const auto type = by_fingerprint_.find(fingerprint(message.bytes));
  if (type == by_fingerprint_.end()) return;
  if (sends_ && below(kBeforeOneIn) == 0) send_before(message, *type->second);
  const auto sample = samples_.try_emplace(std::string(message.channel)).first;
  if (sample->second.uses < kSampleUses && sample->second.type != nullptr) return;
  set_sample(*type->second, message.bytes, sample->second);
}

void FuzzedMission::observe_heartbeat(std::span<const std::uint8_t> bytes) {
  const auto message = decode<heartbeat_t>(bytes);
  if (!message) return;
  if (const auto heartbeat = from_message(*message)) last_heartbeat_[heartbeat->stage] = *heartbeat;
}

void FuzzedMission::observe_phase(std::span<const std::uint8_t> bytes) {
  const auto phase = decode<phase_t>(bytes);
  has_ended_ = has_ended_ || (phase && phase->phase == phase_t::PHASE_ENDED);
}

void FuzzedMission::check_command(std::span<const std::uint8_t> bytes) {
  const auto message = decode<drive_command_t>(bytes);
  if (!message || !from_message(*message)) {
    bad_commands_.emplace_back("a command that is rejected");
    return;
  }
  const bool within =
      std::abs(message->speed_m_s) <= params_.vehicle.speed_max_m_s + kTolerance &&
      std::abs(message->curvature_1_m) * params_.vehicle.turning_radius_m <= 1.0 + kTolerance;
  if (within) return;
  bad_commands_.push_back(
      fmt::format("a command of {} m/s and {} 1/m", message->speed_m_s, message->curvature_1_m));
}

void FuzzedMission::advance() {
  alive_();
  bus_.advance_to(sim_.next_utime());
  sim_.step();
}

std::int64_t FuzzedMission::step() {
  const std::int64_t before = sent_;
  sends_ = true;
  advance();
  if (below(kBurstOneIn) == 0) send_burst();
  sends_ = false;
  return sent_ - before;
}

/// Sends mutated copies of a message before it is delivered: a stage that waits for a message of
/// this time uses the first that arrives.
void FuzzedMission::send_before(const ReceivedMessage& message, const MessageType& type) {
  const std::string channel(message.channel);
  if (message.bytes.size() > kCopiedMax ||
      std::ranges::find(subscribed_, channel) == subscribed_.end())
    return;
  Sample sample;
  set_sample(type, message.bytes, sample);
  sample.is_current = true;
  sends_ = false;
  for (int i = 0; i < kCopies; ++i) send(channel, sample);
  sends_ = true;
}

/// Messages of one channel.
void FuzzedMission::send_burst() {
  const std::string& channel = subscribed_[below(subscribed_.size())];
  if (channel == channels::kMissionOrder && below(kOrderOneIn) != 0) return;
  Sample& sample = samples_.at(channel);
  const bool is_long = std::ranges::find(kLong, channel) != kLong.end();
  for (int i = 0; i < (is_long ? kLongBurstLength : kBurstLength); ++i) send(channel, sample);
}

void FuzzedMission::send(const std::string& channel, Sample& sample) {
  alive_();
  ++sample.uses;
  const Bytes message = mutated(sample);
  const auto start = std::chrono::steady_clock::now();
  injecting_ = true;
  bus_.publish(channel, message);
  const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - start;
  ChannelCounts& counts = counts_[channel];
  ++counts.sent;
  ++sent_;
  counts.max_ms = std::max(counts.max_ms, taken.count());
}

/// Its time is that of now, as of a sender on the bus, unless it is the time that is mutated.
Bytes FuzzedMission::mutated(const Sample& sample) {
  Bytes bytes = sample.bytes;
  const auto& fields = sample.fields;
  const auto utime = fields.find("utime");
  if (!sample.is_current && utime != fields.end() && below(4) != 0)
    write_bits(utime->second.front(), static_cast<std::uint64_t>(bus_.now_utime()), bytes);
  if (fields.empty() || below(kFieldsOneIn) == 0) return mutator_.mutate({bytes}, bytes);
  change_field(sample, bytes);
  if (below(kSecondFieldOneIn) == 0) change_field(sample, bytes);
  return bytes;
}

void FuzzedMission::change_field(const Sample& sample, Bytes& bytes) {
  const auto& fields = sample.fields;
  const auto field = std::next(fields.begin(), static_cast<std::ptrdiff_t>(below(fields.size())));
  const FieldPlace& place = field->second[below(field->second.size())];
  const std::vector<std::uint64_t> extremes = extreme_bits(place);
  const bool random = below(4) == 0;
  write_bits(place, random ? mutator_.random() : extremes[below(extremes.size())], bytes);
}

std::map<std::string, ChannelCounts, std::less<>> FuzzedMission::counts() const {
  auto counts = counts_;
  const auto add = [&counts](const std::vector<SubscriptionStats>& all) {
    for (const SubscriptionStats& stats : all) {
      const auto found = counts.find(stats.channel);
      if (found == counts.end()) continue;
      ++found->second.subscriptions;
      found->second.rejected += stats.rejected;
    }
  };
  add(sim_host_.subscription_stats());
  for (const auto& node : nodes_) add(node->subscription_stats());
  return counts;
}

std::vector<std::string> FuzzedMission::recover() {
  std::vector<std::string> missing;
  const std::int64_t end = bus_.now_utime() + kRecoveryMaxUs;
  do {
    const std::int64_t next = bus_.now_utime() + kRecoveryUs;
    while (bus_.now_utime() < next) {
      advance();
    }
    missing = missing_output();
  } while (!missing.empty() && bus_.now_utime() < end);
  return missing;
}

/// Periodic output of the stages that is old. With it, what the stages report.
std::vector<std::string> FuzzedMission::missing_output() const {
  std::vector<std::string> missing;
  for (const std::string_view channel : kPeriodic) {
    const auto last = last_utime_.find(channel);
    const double age_s =
        seconds(bus_.now_utime() - (last == last_utime_.end() ? kStartUtime : last->second));
    if (age_s > kAgeMaxS) missing.push_back(fmt::format("no {} for {:.1f} s", channel, age_s));
  }
  for (const std::string& stage : stages_) {
    const auto last = last_heartbeat_.find(stage);
    if (last == last_heartbeat_.end() || seconds(bus_.now_utime() - last->second.utime) > kAgeMaxS)
      missing.push_back(fmt::format("no heartbeat of {}", stage));
  }
  if (missing.empty()) return missing;
  for (const auto& [stage, heartbeat] : last_heartbeat_) {
    if (!heartbeat.health.reason.empty())
      missing.push_back(fmt::format("{} reports: {}", stage, heartbeat.health.reason));
  }
  return missing;
}

std::vector<std::string> FuzzedMission::failures() const {
  std::vector<std::string> failures = bad_commands_;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const StageBus::Failures& failed = nodes_[i]->failures();
    if (failed.count > 0)
      failures.push_back(
          fmt::format("{} failures of {}: {}", failed.count, stages_[i], failed.last));
  }
  if (sim_host_.failures().count > 0)
    failures.push_back("failure of the simulator: " + sim_host_.failures().last);
  const std::string& collision = sim_.simulation().state().failure;
  if (!collision.empty()) failures.push_back("the vehicle has failed: " + collision);
  return failures;
}

bool FuzzedMission::is_over() const {
  return has_ended_ || !sim_.simulation().state().failure.empty();
}

}  // namespace adit::fuzz
