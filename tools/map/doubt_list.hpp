// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/files/spool.hpp"
#include "common/geometry/pose2.hpp"
#include "common/sensing/match_doubt.hpp"
#include "common/types/local_map.hpp"
#include "common/types/map_contradictions.hpp"
#include "tools/eval/trajectory.hpp"

namespace adit {

/// A stretch of the path on which the map may be wrong.
struct DoubtfulStretch {
  std::int64_t from_utime = 0;
  std::int64_t to_utime = 0;
  double from_m = 0.0;  ///< distance along the path
  double to_m = 0.0;
  std::size_t motions = 0;           ///< doubtful motions between scans; 0: local maps contradict
  std::size_t alternatives = 0;      ///< most poses at which one of these scans matches
  std::vector<std::string> reasons;  ///< each once: "lost", "poor match", ..., in order
  std::vector<int> local_maps;       ///< ids, increasing
};

/// The distance travelled along a path, in constant memory.
class DistanceAlong {
 public:
  /// `poses`: in order of time.
  template <class Poses>
  explicit DistanceAlong(const Poses& poses) {
    for (const TimedPose& pose : poses) add(pose);
  }

  /// At the first pose from this time on, else at the last [m].
  [[nodiscard]] double operator()(std::int64_t utime) const;

 private:
  struct Point {
    std::int64_t utime;
    double distance_m;
  };

  void add(const TimedPose& pose);

  Spool<Point> points_;
  std::optional<Pose2> last_;
  double distance_m_ = 0.0;
};

/// What the stretches need of a MatchDoubt.
struct MotionDoubt {
  std::int64_t utime = 0;
  std::int64_t from_utime = 0;
  MatchDoubt::Reason reason = MatchDoubt::Reason::kLost;
  std::uint32_t alternatives = 0;
};

/// The fewest stretches that explain all contradictions: the path between two local maps that
/// contradict each other is wrong somewhere, and where the stretches of several pairs have a part
/// in common, an error there explains them all. From the beginning of the older to the end of the
/// newer local map. `local_maps`: those of the run, by id; what lies in earlier runs is left out.
std::vector<DoubtfulStretch> contradictory_stretches(
    const std::vector<MapContradiction>& contradictions, const DistanceAlong& distance_at,
    const std::vector<const LocalMap*>& local_maps);

/// The contradictory stretches, then those of doubtful motions, both along the path. Motions are
/// joined if the body moves at most 2 m between them; more than kStretchesMax stretches of either
/// kind are joined over twice the distance, and so on. `doubts`: in order of time.
std::vector<DoubtfulStretch> doubtful_stretches(const Spool<MotionDoubt>& doubts,
                                                const std::vector<MapContradiction>& contradictions,
                                                const DistanceAlong& distance_at,
                                                const std::vector<LocalMap>& local_maps);
inline constexpr std::size_t kStretchesMax = 200;

/// A line for people, such as "2 doubtful stretches: at 10 to 12 m (lost), at 40 m (ambiguous)";
/// empty without any.
std::string stretches_text(const std::vector<DoubtfulStretch>& stretches);

/// Whether a time lies in a stretch.
bool in_stretches(const std::vector<DoubtfulStretch>& stretches, std::int64_t utime);

}  // namespace adit
