// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace adit {

/// Identifies a topic: 0, 1, ... in the order in which they were added.
using TopicId = std::uint32_t;

/// How the messages of a topic relate to those before them.
enum class Retention {
  kLatest,    ///< each message replaces the one before it
  kAppended,  ///< each message adds to those before it
};

/// A stream of messages to the clients of the viewer.
struct Topic {
  std::string name = {};             ///< e.g. /pose
  std::string encoding = {};         ///< of the messages: json or protobuf
  std::string schema_name = {};      ///< e.g. foxglove.PoseInFrame
  std::string schema_encoding = {};  ///< jsonschema or protobuf
  std::string schema = {};           ///< JSON schema, or a FileDescriptorSet in base64
  Retention retention = Retention::kLatest;
  /// Of kLatest: the shortest wall time between two messages [µs].
  std::int64_t period_us = 0;
};

struct TopicMessage {
  std::int64_t utime = 0;                    ///< bus time of the content [µs since the epoch]
  std::shared_ptr<const std::string> bytes;  ///< shared by all clients
};

/// The topics with their newest messages. A message of kLatest is encoded only when it is due and
/// somebody wants it, so that what nobody looks at costs nothing.
class TopicBoard {
 public:
  /// Messages that a topic of kAppended keeps for clients that connect later; the oldest are
  /// dropped.
  static constexpr std::size_t kAppendedMax = 4000;

  struct Update {
    TopicId topic = 0;
    TopicMessage message;
  };

  using Encode = std::function<std::string()>;

  /// A topic of kLatest. `encode` returns its content now, or an empty text if there is none.
  TopicId add(Topic topic, Encode encode);
  /// A topic of kAppended.
  TopicId add(Topic topic);

  [[nodiscard]] const std::vector<Topic>& topics() const { return topics_; }

  /// Tells that the content of a topic of kLatest has changed, at a bus time.
  void set_changed(TopicId topic, std::int64_t utime);
  /// Adds a message. One with the key of an earlier message replaces that for later clients; no
  /// message has the empty key.
  void append(TopicId topic, std::int64_t utime, std::string bytes, const std::string& key = {});

  /// The messages to send now: appended ones, and changed topics whose period has elapsed and which
  /// are wanted.
  std::vector<Update> take_due(std::int64_t wall_us, const std::function<bool(TopicId)>& wanted);

  /// All that has changed since it was taken, whatever the periods: at the end of a recording.
  std::vector<Update> take_changed();

  /// What a new client gets: the newest message, or all that are kept.
  std::vector<TopicMessage> current(TopicId topic);

 private:
  struct Kept {
    std::string key;
    TopicMessage message;
  };
  struct Content {
    Encode encode;
    std::int64_t utime = 0;
    bool changed = false;  ///< since it was encoded
    std::int64_t encoded_wall_us = 0;
    TopicMessage newest;
    std::deque<Kept> kept;
  };

  /// Of the appended messages those of wanted topics, and the changed topics for which it holds.
  std::vector<Update> take(const std::function<bool(TopicId)>& wanted,
                           const std::function<bool(TopicId)>& is_due);
  /// False if there is no content.
  static bool encode(Content& content);

  std::vector<Topic> topics_;
  std::vector<Content> contents_;
  std::vector<Update> appended_;  ///< since the last take_due
};

}  // namespace adit
