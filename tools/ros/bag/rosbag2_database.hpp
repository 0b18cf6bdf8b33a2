// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <vector>

#include "tools/database/database.hpp"
#include "tools/ros/bag/bag_reader.hpp"

namespace adit {

/// The storage sqlite3 of rosbag2, with messages that may be compressed with zstd, in the order in
/// which they were written. Of a damaged database the messages are read one by one behind the
/// damage.
class Rosbag2Database final : public BagReader {
 public:
  /// Throws FileError if the file is no database, or one without the tables of rosbag2.
  explicit Rosbag2Database(const std::filesystem::path& path);

  std::optional<BagMessage> next() override;
  [[nodiscard]] const std::vector<BagTopic>& topics() const override { return topics_.all(); }
  [[nodiscard]] BagDamage damage() const override { return damage_; }
  [[nodiscard]] double fraction_read() const override;

 private:
  bool step();
  bool step_alone();
  std::optional<BagMessage> message();

  Database database_;
  BagTopics topics_;
  std::map<std::int64_t, std::size_t> ids_;  ///< topic by its id in the database
  std::int64_t last_id_ = 0;
  std::int64_t max_id_ = 0;
  SqlStatement all_;
  std::optional<SqlStatement> one_;  ///< by id, behind damage
  std::vector<std::uint8_t> unpacked_;
  BagDamage damage_;
};

}  // namespace adit
