// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "tools/report/mission_statistics.hpp"
#include "tools/report/svg/map_svg.hpp"

namespace adit {

/// What came of a scan, in a sentence.
std::string outcome_text(const RecordedScan& scan);

/// The scans where the map has them; those of which it does not know where are left out.
std::vector<ScanMark> scan_marks(const MissionRecords& records, const MissionMap& map);

/// What the colours of the cards mean, and a card for each 3D scan.
std::string scan_cards(const MissionRecords& records, const MissionMap& map);

}  // namespace adit
