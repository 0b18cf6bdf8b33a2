// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace adit {

/// A topic of a bag.
struct BagTopic {
  std::string name;
  std::string type;      ///< of ROS, without "msg/": "sensor_msgs/LaserScan"
  std::string encoding;  ///< "ros1" or "cdr"; another one is not read

  friend bool operator==(const BagTopic&, const BagTopic&) = default;
};

/// A message in place: valid until the next one is read.
struct BagMessage {
  std::size_t topic = 0;       ///< index among the topics of the reader
  std::int64_t log_utime = 0;  ///< of the recording [µs since the epoch]
  std::span<const std::uint8_t> data;
};

/// What of a bag cannot be read.
struct BagDamage {
  std::size_t corrupt_regions = 0;
  std::size_t corrupt_bytes = 0;    ///< skipped in all regions, of unpacked chunks too
  std::size_t truncated_bytes = 0;  ///< of an incomplete record at the end
  std::size_t lost_messages =
      0;  ///< whose place is known, not whose content; or whose topic is not known

  BagDamage& operator+=(const BagDamage& part);
  friend bool operator==(const BagDamage&, const BagDamage&) = default;
};

/// What is skipped, without a verb: "12 corrupt bytes in 1 region"; one text for each kind.
std::vector<std::string> texts_of(const BagDamage& damage);

/// The messages of a bag, in the order of the file.
class BagReader {
 public:
  virtual ~BagReader() = default;

  /// The next message, or nothing at the end. What is damaged is skipped and counted.
  virtual std::optional<BagMessage> next() = 0;

  /// The topics found so far; all of them after the last message.
  [[nodiscard]] virtual const std::vector<BagTopic>& topics() const = 0;
  /// Final after the last message.
  [[nodiscard]] virtual BagDamage damage() const = 0;
  /// Share of the bag that has been read, 0 to 1.
  [[nodiscard]] virtual double fraction_read() const = 0;
};

/// Topics by the ids that a file gives them.
class BagTopics {
 public:
  /// The index of a topic; a new one if there is no such topic yet.
  std::size_t index_of(const BagTopic& topic);
  [[nodiscard]] const std::vector<BagTopic>& all() const { return topics_; }

 private:
  std::vector<BagTopic> topics_;
};

/// A type of ROS 1 or 2 without the "msg/" of ROS 2.
std::string plain_type(std::string_view type);

}  // namespace adit
