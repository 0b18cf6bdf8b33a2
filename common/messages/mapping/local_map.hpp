// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "adit/local_map_t.hpp"

#include "common/messages/fragments.hpp"
#include "common/messages/result.hpp"
#include "common/types/local_map.hpp"

namespace adit {

/// A local map with a run of its scans, as it goes onto channel LOCAL_MAP; see
/// local_map_pieces.hpp.
struct LocalMapFragment {
  static constexpr int kFragmentsMax = 1000;  ///< of a local map

  LocalMap part;  ///< complete but for its scans
  int n_fragments = 1;
  int fragment = 0;  ///< 0 to n_fragments − 1

  friend bool operator==(const LocalMapFragment&, const LocalMapFragment&) = default;
};

/// Comes back with the same bits.
local_map_t to_message(const LocalMapFragment& fragment);

/// Refused: implausible times, an end before the beginning, a negative id or session, a pose that
/// is not finite, an information matrix that is none, more pieces than plausible or a piece that is
/// not one of them, more bytes than a piece may have, and scans that could not come from a laser or
/// are outside of the time of the local map. Ranges are passed on as they are.
Result<LocalMapFragment> from_message(const local_map_t& message);

/// Divides a local map, always in the same way: each piece but the last takes as many scans as fit
/// kFragmentBytes; a scan that is larger alone has a piece to itself.
std::vector<LocalMapFragment> split(const LocalMap& map);

/// Joins the pieces of local maps, in whatever order they come. Of an id it waits for the newest
/// only, that is the one with the latest end. What it holds is bounded: where too much is
/// incomplete, the local map whose last piece came longest ago is given up.
class LocalMapReassembler {
 public:
  struct Limits {
    std::size_t incomplete = 8;      ///< local maps
    std::size_t bytes = 64'000'000;  ///< of the scans in all pieces that are held
  };

  /// Since the start. All but `joined` is lost, to this receiver.
  struct Counts {
    std::int64_t reassembled = 0;    ///< local maps given back
    std::int64_t duplicates = 0;     ///< pieces that were there already
    std::int64_t contradictory = 0;  ///< pieces with another head than those before them
    std::int64_t outdated = 0;       ///< pieces of an older revision
    std::int64_t superseded = 0;     ///< incomplete local maps for which a newer revision came
    std::int64_t abandoned = 0;      ///< incomplete local maps that took too much room

    friend bool operator==(const Counts&, const Counts&) = default;
  };

  LocalMapReassembler() : LocalMapReassembler(Limits{}) {}
  explicit LocalMapReassembler(const Limits& limits) : limits_(limits) {}

  /// The local map that this piece completes, or nothing.
  std::optional<LocalMap> add(const LocalMapFragment& fragment);

  [[nodiscard]] const Counts& counts() const { return counts_; }
  /// Local maps that wait for pieces.
  [[nodiscard]] std::size_t incomplete() const { return incomplete_.size(); }

 private:
  struct Incomplete {
    LocalMap header;  // without scans
    FragmentSet<std::vector<LocalScan>> scans;
    std::size_t bytes = 0;           // of the scans
    std::int64_t last_received = 0;  // number of the last piece
  };

  Incomplete* find_or_start(const LocalMapFragment& fragment);
  LocalMap take(int id);
  void enforce_limits();
  void erase(std::map<int, Incomplete>::iterator entry);

  Limits limits_;
  Counts counts_;
  std::map<int, Incomplete> incomplete_;  // by id
  std::size_t bytes_ = 0;
  std::int64_t fragments_received_ = 0;
};

}  // namespace adit
