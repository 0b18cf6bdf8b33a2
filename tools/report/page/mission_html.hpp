// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "tools/report/page/topic_recorder.hpp"
#include "viewer/server/topic_board.hpp"

namespace adit {

/// The page with a finished mission inside: a file that shows it anywhere, without a network. The
/// data are the element `mission-data`: in Base64 of gzip the length of a header (u32,
/// little-endian as all numbers), the header (JSON: serverInfo and channels as the server
/// advertises them), then for each message number of the channel (u32), nanoseconds since the epoch
/// (u64), length (u32), bytes. Throws std::invalid_argument if the page has no </body>.
std::string mission_html(const std::string& page, const std::string& title,
                         const std::vector<Topic>& topics,
                         const std::vector<TopicRecorder::Record>& records);

}  // namespace adit
