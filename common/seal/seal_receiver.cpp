// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/seal/seal_receiver.hpp"

#include <algorithm>

namespace adit {
namespace {

/// Erases the element with the smallest value of `key` if the map is full.
template <class Map, class Key>
void make_room(Map& map, Key key) {
  if (map.size() < SealReceiver::kSessionsMax) return;
  map.erase(std::min_element(map.begin(), map.end(), [&](const auto& a, const auto& b) {
    return key(a.second) < key(b.second);
  }));
}

}  // namespace

std::string_view SealReceiver::check(std::string_view channel, std::span<const std::uint8_t> bytes,
                                     std::int64_t now_us) {
  const auto sealed = split_seal(bytes);
  if (!sealed) return kUnsealed;
  if (!key_.matches(channel, *sealed)) return kForged;
  const SealTrailer& seal = sealed->seal;
  Session* const session = find(seal.session, now_us);
  if (session == nullptr) return ask(seal.session, now_us);
  std::int64_t& last =
      session->last.try_emplace(std::string(channel), session->first).first->second;
  if (seal.sequence <= last) return kReplayed;
  const std::int64_t since_answer_us = seal.sequence - session->answer_sequence;
  const std::int64_t age_us = now_us - session->answered_us - since_answer_us;
  if (age_us > kAgeMaxUs) return kReplayed;
  last = seal.sequence;
  return {};
}

/// Nothing also for a session whose process has answered nothing for long: it has ended, or the
/// times of its answers no longer tell its clock.
SealReceiver::Session* SealReceiver::find(const SealNonce& session, std::int64_t now_us) {
  const auto found = sessions_.find(session);
  if (found == sessions_.end()) return nullptr;
  if (now_us - found->second.answered_us <= kForgetUs) return &found->second;
  sessions_.erase(found);
  return nullptr;
}

std::string_view SealReceiver::ask(const SealNonce& session, std::int64_t now_us) {
  wants_challenge_ = true;
  auto found = unknown_.find(session);
  if (found == unknown_.end()) {
    make_room(unknown_, [](std::int64_t first_us) { return first_us; });
    found = unknown_.emplace(session, now_us).first;
  }
  return now_us - found->second > kAnswerMaxUs ? kUnanswered : kUnknown;
}

std::optional<SealNonce> SealReceiver::take_challenge(std::int64_t now_us) {
  const std::int64_t since_us =
      challenges_.empty() ? kRepeatUs : now_us - challenges_.back().sent_us;
  if (since_us < (wants_challenge_ ? kAskAgainUs : kRepeatUs)) return std::nullopt;
  wants_challenge_ = false;
  challenges_.push_back({random_nonce(), now_us});
  while (now_us - challenges_.front().sent_us > kAnswerMaxUs) challenges_.pop_front();
  return challenges_.back().nonce;
}

std::string_view SealReceiver::add_answer(std::string_view channel,
                                          std::span<const std::uint8_t> bytes,
                                          const SealNonce& nonce, std::int64_t now_us) {
  const auto sealed = split_seal(bytes);
  if (!sealed) return kUnsealed;
  if (!key_.matches(channel, *sealed)) return kForged;
  const SealTrailer& seal = sealed->seal;
  Session* session = find(seal.session, now_us);
  if (nonce == SealNonce{}) {
    if (session == nullptr) ask(seal.session, now_us);
    return {};
  }
  if (!is_outstanding(nonce, now_us)) return {};  // of another receiver, or too late
  if (session != nullptr && seal.sequence <= session->answer_sequence) return kReplayed;
  if (session == nullptr) {
    session = &add(seal.session);
    session->first = seal.sequence;
  }
  session->answer_sequence = seal.sequence;
  session->answered_us = now_us;
  return {};
}

SealReceiver::Session& SealReceiver::add(const SealNonce& session) {
  unknown_.erase(session);
  make_room(sessions_, [](const Session& s) { return s.answered_us; });
  return sessions_[session];
}

bool SealReceiver::is_outstanding(const SealNonce& nonce, std::int64_t now_us) const {
  return std::any_of(challenges_.begin(), challenges_.end(), [&](const Challenge& challenge) {
    return challenge.nonce == nonce && now_us - challenge.sent_us <= kAnswerMaxUs;
  });
}

}  // namespace adit
