// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/ros/bag/bag_files.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <optional>
#include <span>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "common/config/config_file.hpp"
#include "common/files/file_error.hpp"
#include "common/files/mapped_file.hpp"
#include "common/files/new_file.hpp"
#include "common/files/output_file.hpp"
#include "common/files/zstd_stream.hpp"
#include "common/text/message_text.hpp"
#include "tools/ros/bag/mcap_reader.hpp"
#include "tools/ros/bag/ros1_bag_reader.hpp"
#include "tools/ros/bag/rosbag2_database.hpp"

namespace adit {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSqlite = "SQLite format 3";
constexpr const char* kMetadata = "metadata.yaml";

std::vector<std::uint8_t> first_bytes(const fs::path& file) {
  std::vector<std::uint8_t> begin(16);
  std::ifstream stream(file, std::ios::binary);
  stream.read(reinterpret_cast<char*>(begin.data()), static_cast<std::streamsize>(begin.size()));
  begin.resize(static_cast<std::size_t>(std::max<std::streamsize>(stream.gcount(), 0)));
  return begin;
}

bool is_database(std::span<const std::uint8_t> begin) {
  return std::string_view(reinterpret_cast<const char*>(begin.data()), begin.size())
      .starts_with(kSqlite);
}

/// A file of rosbag2 that is compressed as a whole: run_0.db3.zstd.
bool is_compressed_file(const fs::path& file) {
  const std::string inner = file.stem().extension().string();
  return (file.extension() == ".zstd" || file.extension() == ".zst") &&
         (inner == ".db3" || inner == ".mcap");
}

bool is_bag_file(const fs::path& file) {
  if (is_compressed_file(file)) return true;
  const auto begin = first_bytes(file);
  return is_ros1_bag(begin) || is_mcap(begin) || is_database(begin);
}

bool has_bag_extension(const fs::path& file) {
  return file.extension() == ".mcap" || file.extension() == ".db3" || file.extension() == ".bag" ||
         is_compressed_file(file);
}

/// run_2 before run_10.
bool before(const fs::path& a, const fs::path& b) {
  const std::string left = a.string();
  const std::string right = b.string();
  return left.size() == right.size() ? left < right : left.size() < right.size();
}

/// The files that metadata.yaml lists, in its order; nothing without a readable one.
std::optional<std::vector<fs::path>> listed_files(const fs::path& folder) {
  if (!fs::exists(folder / kMetadata)) return std::nullopt;
  try {
    const ConfigFile metadata = ConfigFile::load(folder / kMetadata);
    const ConfigNode* const info = metadata.section("rosbag2_bagfile_information");
    const ConfigNode* const names = info ? info->find("relative_file_paths") : nullptr;
    if (names == nullptr || names->children.empty()) return std::nullopt;
    std::vector<fs::path> files;
    for (const ConfigNode& name : names->children) files.push_back(folder / name.text);
    return files;
  } catch (const ConfigError&) {
    return std::nullopt;
  }
}

std::vector<fs::path> files_in(const fs::path& folder) {
  if (auto files = listed_files(folder)) return *files;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file() && has_bag_extension(entry.path())) files.push_back(entry.path());
  }
  std::ranges::sort(files, before);
  return files;
}

/// The content of a compressed file, in a file with a name, which SQLite needs; it ends with the
/// object, since it is never published.
std::unique_ptr<NewFile> unpacked_file(const fs::path& path, BagDamage& damage) {
  const MappedFile packed(path);
  auto file = std::make_unique<NewFile>(fs::temp_directory_path() / path.stem());
  OutputFile output(file->part(), path);
  ZstdDecoder decoder(packed.bytes());
  std::vector<std::uint8_t> content;
  while (decoder.read(content)) {
    output.write({reinterpret_cast<const char*>(content.data()), content.size()});
    content.clear();
  }
  packed.require_readable();
  output.close();
  damage.corrupt_regions += decoder.damage().corrupt_regions;
  damage.corrupt_bytes += decoder.damage().corrupt_bytes;
  damage.truncated_bytes += decoder.damage().truncated_bytes;
  return file;
}

/// One file, with what its reader needs.
class BagFile final : public BagReader {
 public:
  explicit BagFile(const fs::path& path) {
    if (is_compressed_file(path)) unpacked_ = unpacked_file(path, of_compression_);
    const fs::path plain = unpacked_ ? unpacked_->part() : path;
    if (is_database(first_bytes(plain))) {
      reader_ = std::make_unique<Rosbag2Database>(plain);
      return;
    }
    file_ = std::make_unique<MappedFile>(plain);
    if (is_mcap(file_->bytes())) {
      reader_ = std::make_unique<McapReader>(file_->bytes());
    } else {
      reader_ = std::make_unique<Ros1BagReader>(file_->bytes());
    }
  }

  std::optional<BagMessage> next() override {
    auto message = reader_->next();
    if (file_) file_->require_readable();
    return message;
  }
  [[nodiscard]] const std::vector<BagTopic>& topics() const override { return reader_->topics(); }
  [[nodiscard]] BagDamage damage() const override {
    BagDamage all = of_compression_;
    return all += reader_->damage();
  }
  [[nodiscard]] double fraction_read() const override { return reader_->fraction_read(); }

 private:
  std::unique_ptr<NewFile> unpacked_;
  std::unique_ptr<MappedFile> file_;
  BagDamage of_compression_;
  std::unique_ptr<BagReader> reader_;
};

std::unique_ptr<BagReader> open_file(const fs::path& path) {
  try {
    return std::make_unique<BagFile>(path);
  } catch (const FileError&) {  // names the file
    throw;
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("{}: {}", path.string(), error.what()));
  }
}

/// The files of a folder, one after the other.
class BagFolder final : public BagReader {
 public:
  /// `warnings` gets the files that cannot be opened.
  BagFolder(std::vector<fs::path> files, std::vector<std::string>& warnings)
      : files_(std::move(files)) {
    std::erase_if(files_, [&warnings](const fs::path& file) {
      try {
        open_file(file);
        return false;
      } catch (const std::runtime_error& error) {
        warnings.push_back(fmt::format("a file of the bag: {}", error.what()));
        return true;
      }
    });
  }

  [[nodiscard]] bool empty() const { return files_.empty(); }

  std::optional<BagMessage> next() override {
    while (true) {
      if (!file_ && opened_ == files_.size()) return std::nullopt;
      if (!file_) file_ = open_file(files_[opened_++]);
      if (auto message = file_->next()) {
        message->topic = topics_.index_of(file_->topics()[message->topic]);
        return message;
      }
      for (const BagTopic& topic : file_->topics()) topics_.index_of(topic);
      damage_ += file_->damage();
      file_.reset();
    }
  }

  [[nodiscard]] const std::vector<BagTopic>& topics() const override { return topics_.all(); }
  [[nodiscard]] BagDamage damage() const override { return damage_; }
  [[nodiscard]] double fraction_read() const override {
    const double done = file_ ? static_cast<double>(opened_) - 1.0 + file_->fraction_read()
                              : static_cast<double>(opened_);
    return done / static_cast<double>(files_.size());
  }

 private:
  std::vector<fs::path> files_;
  std::size_t opened_ = 0;
  std::unique_ptr<BagReader> file_;
  BagTopics topics_;
  BagDamage damage_;
};

}  // namespace

bool is_bag(const fs::path& path) {
  std::error_code ignored;
  if (!fs::is_directory(path, ignored)) return is_bag_file(path);
  if (fs::exists(path / kMetadata, ignored)) return true;
  return std::ranges::any_of(fs::directory_iterator(path, ignored),
                             [](const auto& entry) { return has_bag_extension(entry.path()); });
}

std::unique_ptr<BagReader> open_bag(const fs::path& path, std::vector<std::string>& warnings) {
  if (!fs::is_directory(path)) return open_file(path);
  const std::vector<fs::path> files = files_in(path);
  if (files.empty()) {
    throw std::runtime_error(
        fmt::format("no file .mcap, .db3 or .bag in the folder {}", path.string()));
  }
  auto folder = std::make_unique<BagFolder>(files, warnings);
  if (folder->empty()) throw std::runtime_error(warnings.back());
  return folder;
}

}  // namespace adit
