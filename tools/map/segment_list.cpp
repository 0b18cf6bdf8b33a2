// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/map/segment_list.hpp"

#include <algorithm>
#include <utility>

namespace adit {
namespace {

using Segment = SegmentList::Segment;

bool same_kind(const Segment& a, const Segment& b) {
  return a.lost == b.lost && a.filled == b.filled;
}

/// From 1; 0 for a scan that observed all motion.
int kind_of(const Segment& segment) { return segment.lost ? 1 : segment.filled ? 2 : 3; }

/// Appends a segment, or extends the last one of its kind if that ends at most `joined_m` before.
void append(const Segment& next, double joined_m, std::vector<Segment>& segments) {
  const auto last = std::find_if(segments.rbegin(), segments.rend(),
                                 [&](const Segment& segment) { return same_kind(segment, next); });
  if (last == segments.rend() || next.from_m - last->to_m > joined_m) {
    segments.push_back(next);
    return;
  }
  last->to_utime = next.to_utime;
  last->to_m = next.to_m;
  last->length_m += next.length_m;
  last->scans += next.scans;
  last->intervals += next.intervals;
}

}  // namespace

bool is_unobserved(const ScanMatch& match) {
  return match.status == ScanMatch::Status::kLost || !match.degenerate.empty();
}

void SegmentList::add(const ScanMatch& match) {
  const double moved_m = match.T_reference_body.translation().norm();
  const double from_m = std::exchange(travelled_m_, travelled_m_ + moved_m);
  if (!is_unobserved(match)) {
    last_kind_ = 0;
    return;
  }
  Segment scan{match.reference_utime, match.utime, moved_m, 1, 1};
  scan.lost = match.status == ScanMatch::Status::kLost;
  scan.filled = !scan.lost && !has_unobserved_direction(match);
  scan.from_m = from_m;
  scan.to_m = travelled_m_;
  if (std::exchange(last_kind_, kind_of(scan)) == last_kind_) scan.intervals = 0;
  append(scan, joined_m_, segments_);
  while (segments_.size() > kSegmentsMax) join();
}

void SegmentList::join() {
  joined_m_ *= 2.0;
  std::vector<Segment> joined;
  for (const Segment& segment : segments_) append(segment, joined_m_, joined);
  segments_ = std::move(joined);
}

}  // namespace adit
