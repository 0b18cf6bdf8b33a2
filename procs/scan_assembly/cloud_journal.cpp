// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/scan_assembly/cloud_journal.hpp"

#include <algorithm>
#include <string_view>

#include "common/messages/codec.hpp"
#include "common/messages/mapping/cloud.hpp"

namespace adit {
namespace {

constexpr std::string_view kFragment = "CLOUD_FRAGMENT";

/// Reassembles the clouds of which the journal has all fragments.
class CloudReader {
 public:
  explicit CloudReader(std::vector<Cloud>& clouds) : clouds_(clouds) {}

  void operator()(const JournalRecord& record) {
    if (record.kind != kFragment) return;
    const auto message = decode<cloud_t>(record.bytes);
    if (!message) return;
    const auto fragment = from_message(*message);
    if (!fragment) return;
    if (auto cloud = assembler_.add(*fragment)) clouds_.push_back(std::move(*cloud));
  }

 private:
  std::vector<Cloud>& clouds_;
  CloudReassembler assembler_;
};

}  // namespace

void CloudBuffer::add(const Cloud& cloud, std::int64_t utime) {
  sent_.push_back({utime, cloud});
  if (sent_.size() > kMax) sent_.pop_front();
}

const Cloud* CloudBuffer::find_missing(const CloudRequest& request, std::int64_t utime) const {
  const auto is_missing = [&](const Sent& sent) {
    const std::int64_t end = sent.cloud.utime;
    return utime - sent.utime >= kResendDelayUs && end > request.after_utime &&
           std::ranges::find(request.received_utime, end) == request.received_utime.end();
  };
  const auto found = std::find_if(sent_.rbegin(), sent_.rend(), is_missing);
  return found == sent_.rend() ? nullptr : &found->cloud;
}

CloudJournal::CloudJournal(const std::filesystem::path& path)
    : journal_(path, CloudReader(restored_)) {
  clouds_ = restored_.size();
  for (const Cloud& cloud : restored_) unacknowledged_utime_.push_back(cloud.utime);
}

/// The scans that are dropped when the journal is full were published long ago; the newest of them
/// can still be requested from the CloudBuffer.
void CloudJournal::store(const Cloud& cloud) {
  if (clouds_ >= kMax) {
    journal_.clear();
    clouds_ = 0;
    unacknowledged_utime_.clear();
  }
  ++clouds_;
  unacknowledged_utime_.push_back(cloud.utime);
  for (const CloudFragment& fragment : split(cloud)) {
    journal_.append(kFragment, encode(to_message(fragment)));
  }
  journal_.sync();
}

void CloudJournal::acknowledge(std::span<const std::int64_t> received_utime) {
  std::erase_if(unacknowledged_utime_, [&](std::int64_t utime) {
    return std::ranges::find(received_utime, utime) != received_utime.end();
  });
  if (!unacknowledged_utime_.empty() || clouds_ == 0) return;
  journal_.clear();
  clouds_ = 0;
}

}  // namespace adit
