// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// The containers of bags: ROS 1, MCAP and the databases of rosbag2, whole and damaged.
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/files/zstd_stream.hpp"
#include "tests/support/bags/ros1_bag_writer.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tools/database/database.hpp"
#include "tools/export/mcap_writer.hpp"
#include "tools/ros/bag/bag_files.hpp"
#include "tools/ros/bag/mcap_reader.hpp"
#include "tools/ros/bag/ros1_bag_reader.hpp"

namespace adit {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::int64_t kBegin = 1'700'000'000'000'123;
constexpr int kChunks = 4;
constexpr int kPerChunk = 10;

/// Content that compression does not make tiny, and that tells which message it is.
std::string content(int i) {
  std::string text;
  for (int k = 0; k < 300; ++k) text += static_cast<char>(i * 31 + k * k % 97);
  return text;
}

struct ReadMessage {
  std::string topic;
  std::int64_t log_utime = 0;
  std::string data;
};

std::vector<ReadMessage> read_all(BagReader& reader) {
  std::vector<ReadMessage> messages;
  while (const auto message = reader.next()) {
    messages.push_back({reader.topics()[message->topic].name, message->log_utime,
                        std::string(message->data.begin(), message->data.end())});
  }
  return messages;
}

/// All messages of the samples below.
void expect_all(const std::vector<ReadMessage>& messages) {
  ASSERT_EQ(messages.size(), static_cast<std::size_t>(kChunks * kPerChunk));
  for (int i = 0; i < kChunks * kPerChunk; ++i) {
    const ReadMessage& message = messages[static_cast<std::size_t>(i)];
    EXPECT_EQ(message.topic, i % 2 == 0 ? "/even" : "/odd");
    EXPECT_EQ(message.log_utime, kBegin + i);
    EXPECT_EQ(message.data, content(i));
  }
}

test::Ros1BagWriter ros1_sample(const std::string& compression) {
  test::Ros1BagWriter bag(compression);
  for (int i = 0; i < kChunks * kPerChunk; ++i) {
    bag.write(i % 2 == 0 ? "/even" : "/odd", "std_msgs/String", kBegin + i, content(i));
    if (i % kPerChunk == kPerChunk - 1) bag.end_chunk();
  }
  return bag;
}

class Ros1Bag : public testing::TestWithParam<const char*> {};

TEST_P(Ros1Bag, IsReadInTheOrderOfTheFile) {
  const auto bytes = ros1_sample(GetParam()).closed();
  Ros1BagReader reader(bytes);
  expect_all(read_all(reader));
  EXPECT_EQ(reader.damage(), BagDamage{});
  EXPECT_THAT(reader.topics(), ElementsAre(BagTopic{"/even", "std_msgs/String", "ros1"},
                                           BagTopic{"/odd", "std_msgs/String", "ros1"}));
}

TEST_P(Ros1Bag, IsReadWithoutItsIndex) {
  const auto bytes = ros1_sample(GetParam()).active();
  Ros1BagReader reader(bytes);
  expect_all(read_all(reader));
  EXPECT_EQ(reader.damage(), BagDamage{});
}

/// The first chunk also has the connections, which the index repeats.
TEST_P(Ros1Bag, LosesOnlyWhatIsDamaged) {
  auto bytes = ros1_sample(GetParam()).closed();
  const std::string text(bytes.begin(), bytes.end());
  const std::size_t chunk = text.find("compression=");
  ASSERT_NE(chunk, std::string::npos);
  std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(chunk) - 20, 600, 0xA5);
  Ros1BagReader reader(bytes);
  const auto messages = read_all(reader);
  EXPECT_GE(messages.size(), static_cast<std::size_t>((kChunks - 1) * kPerChunk));
  EXPECT_EQ(messages.back().data, content(kChunks * kPerChunk - 1));
  EXPECT_EQ(reader.damage().lost_messages, kChunks * kPerChunk - messages.size());
  EXPECT_THAT(texts_of(reader.damage()), testing::Not(IsEmpty()));
}

/// Of the last chunk, those before the end; an LZ4 frame and bzip2 give whole blocks only.
TEST_P(Ros1Bag, IsReadUpToWhereItIsTruncated) {
  auto bytes = ros1_sample(GetParam()).active();
  const std::string text(bytes.begin(), bytes.end());
  const std::size_t last = text.rfind("compression=");
  bytes.resize(last + (bytes.size() - last) / 3);
  Ros1BagReader reader(bytes);
  const auto messages = read_all(reader);
  EXPECT_GE(messages.size(), static_cast<std::size_t>((kChunks - 1) * kPerChunk));
  EXPECT_LT(messages.size(), static_cast<std::size_t>(kChunks * kPerChunk));
  EXPECT_GT(reader.damage().truncated_bytes, 0U);
}

INSTANTIATE_TEST_SUITE_P(Compressions, Ros1Bag, testing::Values("none", "bz2", "lz4"),
                         [](const auto& suite) { return std::string(suite.param); });

TEST(Ros1BagReader, ReadsTheMessagesInADamagedChunkThatIsNotCompressed) {
  auto bytes = ros1_sample("none").closed();
  const std::string text(bytes.begin(), bytes.end());
  const std::size_t fourth = text.find(content(3));
  std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(fourth) - 10, 20, 0xFF);
  Ros1BagReader reader(bytes);
  EXPECT_EQ(read_all(reader).size(), static_cast<std::size_t>(kChunks * kPerChunk - 1));
  EXPECT_EQ(reader.damage().corrupt_regions, 1U);
  EXPECT_EQ(reader.damage().lost_messages, 1U);
}

TEST(Ros1BagReader, SaysWhatToDoWithAnOldFormat) {
  const std::string old = "#ROSBAG V1.2\n";
  const std::vector<std::uint8_t> bytes(old.begin(), old.end());
  try {
    const Ros1BagReader reader(bytes);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("rosbag fix"));
  }
}

void write_mcap(const fs::path& file) {
  McapWriter writer(file, "ros2");
  const McapWriter::Schema schema{"std_msgs/msg/String", "ros2msg", "string data"};
  const auto even = writer.add_channel("/even", "cdr", schema);
  const auto odd = writer.add_channel("/odd", "cdr", schema);
  for (int i = 0; i < kChunks * kPerChunk; ++i) {
    writer.write(i % 2 == 0 ? even : odd, kBegin + i, kBegin, content(i));
    // The writer ends a chunk before metadata.
    if (i % kPerChunk == kPerChunk - 1) writer.write(McapWriter::Metadata{"end", {}});
  }
  writer.close();
}

std::vector<std::uint8_t> bytes_of(const fs::path& file) {
  const std::string text = test::contents(file);
  return {text.begin(), text.end()};
}

class McapFile : public testing::Test {
 protected:
  McapFile() {
    write_mcap(folder_ / "a.mcap");
    bytes_ = bytes_of(folder_ / "a.mcap");
  }

  test::ScratchFolder folder_;
  std::vector<std::uint8_t> bytes_;
};

TEST_F(McapFile, IsReadInTheOrderOfTheFile) {
  McapReader reader(bytes_);
  expect_all(read_all(reader));
  EXPECT_EQ(reader.damage(), BagDamage{});
  EXPECT_THAT(reader.topics(), ElementsAre(BagTopic{"/even", "std_msgs/String", "cdr"},
                                           BagTopic{"/odd", "std_msgs/String", "cdr"}));
}

TEST_F(McapFile, SkipsAChunkWithAWrongChecksum) {
  const std::string text(bytes_.begin(), bytes_.end());
  bytes_[text.find("zstd") + 200] ^= 0x10U;
  McapReader reader(bytes_);
  const auto messages = read_all(reader);
  EXPECT_EQ(messages.size(), static_cast<std::size_t>((kChunks - 1) * kPerChunk));
  EXPECT_EQ(messages.front().topic, "/even");  // the channels were in the damaged chunk, too
  EXPECT_EQ(reader.damage().corrupt_regions, 1U);
  EXPECT_EQ(reader.damage().lost_messages, static_cast<std::size_t>(kPerChunk));
}

TEST_F(McapFile, FindsTheNextChunkBehindDamagedRecords) {
  const std::string text(bytes_.begin(), bytes_.end());
  const auto second = static_cast<std::ptrdiff_t>(text.find("zstd", text.find("zstd") + 4));
  std::fill_n(bytes_.begin() + second - 45, 30, 0x11);
  McapReader reader(bytes_);
  EXPECT_EQ(read_all(reader).size(), static_cast<std::size_t>((kChunks - 1) * kPerChunk));
  EXPECT_GE(reader.damage().corrupt_regions, 1U);
  EXPECT_EQ(reader.damage().lost_messages, static_cast<std::size_t>(kPerChunk));
}

TEST_F(McapFile, IsReadUpToWhereItIsTruncated) {
  const std::string text(bytes_.begin(), bytes_.end());
  std::size_t chunk = 0;
  for (int i = 0; i < 3; ++i) chunk = text.find("zstd", chunk + 1);
  bytes_.resize(chunk + 500);
  McapReader reader(bytes_);
  EXPECT_GE(read_all(reader).size(), static_cast<std::size_t>(2 * kPerChunk));
  EXPECT_GT(reader.damage().truncated_bytes, 0U);
}

void write_database(const fs::path& file, bool compressed) {
  Database database(file, Database::Mode::kWrite);
  database.execute(
      "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT, serialization_format TEXT,"
      " offered_qos_profiles TEXT);"
      "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER, data "
      "BLOB);"
      "INSERT INTO topics VALUES (1, '/even', 'std_msgs/msg/String', 'cdr', ''),"
      " (2, '/odd', 'std_msgs/msg/String', 'cdr', '')");
  for (int i = 0; i < kChunks * kPerChunk; ++i) {
    std::string hex;
    for (const char c : compressed ? zstd_frame(content(i)) : content(i)) {
      constexpr const char* kDigits = "0123456789abcdef";
      const auto byte = static_cast<unsigned char>(c);
      hex += {kDigits[byte / 16], kDigits[byte % 16]};
    }
    database.execute("INSERT INTO messages(topic_id, timestamp, data) VALUES (" +
                     std::to_string(i % 2 + 1) + ", " + std::to_string(1000 * (kBegin + i)) +
                     ", x'" + hex + "')");
  }
  database.execute("PRAGMA wal_checkpoint(TRUNCATE); PRAGMA journal_mode = DELETE");
}

std::vector<ReadMessage> read_bag(const fs::path& path, BagDamage* damage = nullptr) {
  std::vector<std::string> warnings;
  const auto reader = open_bag(path, warnings);
  EXPECT_THAT(warnings, IsEmpty());
  auto messages = read_all(*reader);
  if (damage != nullptr) *damage = reader->damage();
  return messages;
}

TEST(Rosbag2, IsReadFromADatabase) {
  const test::ScratchFolder folder;
  for (const bool compressed : {false, true}) {
    const fs::path file = folder / (compressed ? "packed.db3" : "plain.db3");
    write_database(file, compressed);
    EXPECT_TRUE(is_bag(file));
    expect_all(read_bag(file));
  }
}

/// A page in the middle of a database is lost.
TEST(Rosbag2, LosesOnlyTheDamagedMessagesOfADatabase) {
  const test::ScratchFolder folder;
  write_database(folder / "a.db3", false);
  auto bytes = bytes_of(folder / "a.db3");
  constexpr std::size_t kPage = 4096;
  ASSERT_GT(bytes.size(), 5 * kPage);
  std::fill_n(bytes.begin() + 4 * kPage, kPage, 0xEE);
  std::ofstream(folder / "a.db3", std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
  BagDamage damage;
  const auto messages = read_bag(folder / "a.db3", &damage);
  EXPECT_GT(messages.size(), 20U);
  EXPECT_LT(messages.size(), 40U);
  EXPECT_EQ(messages.back().data, content(39));
  EXPECT_EQ(damage.lost_messages, 40 - messages.size());
}

/// The folder as ros2 bag record leaves it, with two files, one of which is compressed as a whole.
TEST(Rosbag2, IsReadFromAFolderOfSeveralFiles) {
  const test::ScratchFolder folder;
  fs::create_directory(folder / "bag");
  write_mcap(folder / "bag/bag_0.mcap");
  const std::string second = test::contents(folder / "bag/bag_0.mcap");
  std::ofstream(folder / "bag/bag_1.mcap.zstd", std::ios::binary) << zstd_frame(second);
  EXPECT_TRUE(is_bag(folder / "bag"));
  EXPECT_EQ(read_bag(folder / "bag").size(), 80U);
  std::ofstream(folder / "bag/metadata.yaml")
      << "rosbag2_bagfile_information:\n  relative_file_paths:\n    - bag_0.mcap\n    - "
         "bag_7.mcap\n";
  std::vector<std::string> warnings;
  const auto reader = open_bag(folder / "bag", warnings);
  expect_all(read_all(*reader));
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("bag_7.mcap")));
}

TEST(Rosbag2, IsNotAFolderWithoutABag) {
  const test::ScratchFolder folder;
  EXPECT_FALSE(is_bag(folder.path()));
  EXPECT_FALSE(is_bag(folder / "none"));
}

}  // namespace
}  // namespace adit
