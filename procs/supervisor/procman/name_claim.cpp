// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/procman/name_claim.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/service/node_end.hpp"
#include "common/text/message_text.hpp"

namespace adit {
namespace {

constexpr std::int64_t kProbePeriodUs = 250'000;
constexpr std::int64_t kReportedUs = 10'000'000;  // after the last message of the other
constexpr std::size_t kPublishedMax = 1000;       // more than are in the queues of the bus

}  // namespace

NameClaim::NameClaim(std::string name, std::int64_t nonce, double listen_s, std::int64_t now_us)
    : name_(std::move(name)),
      nonce_(nonce),
      listen_until_us_(now_us + std::llround(listen_s * 1e6)),
      next_probe_us_(now_us) {}

std::optional<ProcmanDiscovery> NameClaim::take_probe(std::int64_t utime, std::int64_t now_us) {
  if (held_ || now_us < next_probe_us_ || now_us >= listen_until_us_) return std::nullopt;
  next_probe_us_ = now_us + kProbePeriodUs;
  return ProcmanDiscovery{utime, name_, nonce_};
}

void NameClaim::on_message(const ProcmanDiscovery& probe) {
  if (!held_ && probe.from == name_ && probe.nonce < nonce_) lost_ = true;
}

void NameClaim::on_message(const ProcmanInfo& info, std::int64_t now_us) {
  if (info.deputy != name_) return;
  if (!held_) {
    lost_ = true;
  } else if (std::ranges::find(published_utimes_, info.utime) == published_utimes_.end()) {
    other_us_ = now_us;
  }
}

void NameClaim::published(const ProcmanInfo& info) {
  published_utimes_.push_back(info.utime);
  if (published_utimes_.size() > kPublishedMax) published_utimes_.pop_front();
}

bool NameClaim::is_held(std::int64_t now_us) {
  if (lost_) {
    throw NodeEnd("another supervisor named " + quote(name_) +
                  " runs on this network: stop it, or set supervisor.deputy_id");
  }
  held_ = held_ || now_us >= listen_until_us_;
  return held_;
}

std::string NameClaim::problem(std::int64_t now_us) const {
  if (!other_us_ || now_us > *other_us_ + kReportedUs) return {};
  return "another supervisor named " + quote(name_) + " runs on this network";
}

}  // namespace adit
