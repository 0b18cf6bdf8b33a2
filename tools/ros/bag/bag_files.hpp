// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "tools/ros/bag/bag_reader.hpp"

namespace adit {

/// Whether a path is a bag of ROS, by the first bytes of a file or the files in a folder: a ROS 1
/// bag, an MCAP file, a database of rosbag2, each of the latter also compressed as a file (.zstd),
/// or the folder of a rosbag2.
bool is_bag(const std::filesystem::path& path);

/// Opens a bag; the files of a folder one after the other. What is missing or unreadable in a
/// folder of several files is added to `warnings`, without a verb. Throws std::runtime_error with
/// the path if nothing can be read.
std::unique_ptr<BagReader> open_bag(const std::filesystem::path& path,
                                    std::vector<std::string>& warnings);

}  // namespace adit
