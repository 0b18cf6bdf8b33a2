// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/scan_assembly/cloud_journal.hpp"

#include <algorithm>

#include "common/messages/cloud_pieces.hpp"
#include "common/messages/codec.hpp"

namespace adit {
namespace {

constexpr std::string_view kPiece = "CLOUD_PIECE";

/// Joins the pieces of which a journal has all.
class CloudReader {
 public:
  explicit CloudReader(std::vector<Cloud>& clouds) : clouds_(clouds) {}

  void operator()(const JournalRecord& record) {
    if (record.kind != kPiece) return;
    const auto message = decode<cloud_t>(record.bytes);
    if (!message) return;
    const auto piece = from_message(*message);
    if (!piece) return;
    if (auto cloud = assembler_.add(*piece)) clouds_.push_back(std::move(*cloud));
  }

 private:
  std::vector<Cloud>& clouds_;
  CloudAssembler assembler_;
};

}  // namespace

CloudJournal::CloudJournal(const std::filesystem::path& path)
    : journal_(path, CloudReader(restored_)) {
  clouds_ = restored_.size();
  for (const Cloud& cloud : restored_) lacked_utime_.push_back(cloud.utime);
}

/// What it begins anew without has been announced long ago, and may be asked for in memory.
void CloudJournal::keep(const Cloud& cloud) {
  if (clouds_ >= kMax) {
    journal_.clear();
    clouds_ = 0;
    lacked_utime_.clear();
  }
  ++clouds_;
  lacked_utime_.push_back(cloud.utime);
  for (const CloudPiece& piece : divide(cloud)) {
    journal_.append(kPiece, encode(to_message(piece)));
  }
  journal_.sync();
}

void CloudJournal::let_go(std::span<const std::int64_t> have_utime) {
  std::erase_if(lacked_utime_, [&](std::int64_t utime) {
    return std::ranges::find(have_utime, utime) != have_utime.end();
  });
  if (!lacked_utime_.empty() || clouds_ == 0) return;
  journal_.clear();
  clouds_ = 0;
}

}  // namespace adit
