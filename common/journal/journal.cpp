// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/journal/journal.hpp"

#include <cerrno>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "common/files/file_error.hpp"
#include "common/files/mapped_file.hpp"

namespace adit {
namespace {

namespace fs = std::filesystem;
using Found = JournalScan::Found;

constexpr const char* kDamagedSuffix = ".damaged";
constexpr const char* kNewSuffix = ".new";

fs::path with_suffix(fs::path path, const char* suffix) { return path += suffix; }

/// Removes a partially written record. If that fails too, the next record overwrites it, and any
/// remaining bytes are skipped when the journal is read.
void discard_partial_record(const LockedFile& file, std::uint64_t end) {
  try {
    file.truncate(end);
  } catch (const std::runtime_error&) {  // NOLINT(bugprone-empty-catch): report the first error
  }
}

/// Zeros after the last record are space that was reserved, unless the disk could not read them.
JournalScan scan_of(const MappedFile& file) {
  JournalScan scan = scan_journal(file.bytes());
  if (file.is_readable(file.bytes().last(scan.truncated_bytes))) return scan;
  const std::size_t bytes = std::exchange(scan.truncated_bytes, 0);
  scan.corrupt.push_back({scan.bytes - bytes, bytes});
  return scan;
}

/// The records of all copies, and the bytes to which they refer.
class OpenedCopies {
 public:
  /// The file at the first path must exist.
  explicit OpenedCopies(const std::vector<fs::path>& paths) {
    for (const fs::path& path : paths) {
      files_.push_back(std::make_unique<MappedFile>(path));
      scans_.push_back(scan_of(*files_.back()));
    }
    contents_ = join_copies(scans_);
    if (contents_.records.empty() && !may_be_journal(files_.front()->bytes())) {
      throw FileError(paths.front().string() + ": not a journal");
    }
  }

  void read(const JournalReader& reader) const {
    for (const Found& found : contents_.records) reader(found.record);
  }

  [[nodiscard]] const std::vector<JournalScan>& scans() const { return scans_; }
  [[nodiscard]] const JournalContents& contents() const { return contents_; }

 private:
  std::vector<std::unique_ptr<MappedFile>> files_;
  std::vector<JournalScan> scans_;
  JournalContents contents_;
};

/// The number of bytes at the beginning of a file that are the first of the joined records; nothing
/// if the file holds anything else but an incomplete record.
std::optional<std::size_t> common_bytes(const JournalScan& scan, const std::vector<Found>& joined) {
  if (!scan.corrupt.empty() || scan.has_old_records) return std::nullopt;
  if (scan.records.size() > joined.size()) return std::nullopt;
  for (std::size_t i = 0; i < scan.records.size(); ++i) {
    const Found& record = scan.records[i];
    if (record.sequence() != joined[i].sequence() || record.checksum != joined[i].checksum)
      return std::nullopt;
  }
  return scan.bytes - scan.truncated_bytes;
}

/// Encodes records one after the other.
class Writer {
 public:
  explicit Writer(std::uint64_t offset) : offset_(offset) {}

  /// Returns the end of the records.
  std::uint64_t write(std::span<const Found> records, const LockedFile& file) {
    for (const Found& found : records) {
      const auto bytes = journal_format::write(found.record, *found.place);
      file.write_at(offset_, bytes);
      offset_ += bytes.size();
    }
    return offset_;
  }

 private:
  std::uint64_t offset_;
};

std::uint64_t encoded_bytes(const std::vector<Found>& records) {
  std::uint64_t bytes = 0;
  for (const Found& found : records) {
    bytes += journal_format::kHeaderBytes + found.record.kind.size() + found.record.bytes.size();
  }
  return bytes;
}

/// Records of the old format get the place by which the new format names them.
void convert(std::vector<Found>& records) {
  for (std::size_t i = 0; i < records.size(); ++i) {
    journal_format::Place place = *records[i].place;
    const bool follows = i > 0 && records[i - 1].sequence() + 1 == place.sequence;
    if (follows) place.previous = records[i - 1].checksum;
    const auto bytes = journal_format::write(records[i].record, place);
    records[i].place = place;
    records[i].checksum = journal_format::checksum_of(bytes);
  }
}

}  // namespace

fs::path journal_copy(const fs::path& path) {
  fs::path name = path.stem();
  name += ".copy";
  name += path.extension();
  return path.parent_path() / name;
}

JournalHealth read_journal(const fs::path& path, const JournalReader& reader) {
  std::vector<fs::path> paths{path};
  if (const fs::path copy = journal_copy(path); fs::exists(copy)) {
    paths.push_back(copy);
    if (!fs::exists(path)) paths.erase(paths.begin());
  }
  const OpenedCopies opened(paths);
  opened.read(reader);
  return opened.contents().health;
}

Journal::Journal(const fs::path& path, const JournalReader& reader) {
  const std::vector<fs::path> paths{path, journal_copy(path)};
  const bool has_all =
      std::all_of(paths.begin(), paths.end(), [](auto& p) { return fs::exists(p); });
  const bool has_first = fs::exists(path);
  for (const fs::path& p : paths) copies_.push_back({std::make_unique<LockedFile>(p)});
  const OpenedCopies opened(paths);
  health_ = opened.contents().health;
  if (!has_first) health_.recovered += std::exchange(health_.behind, 0);  // the file was removed
  if (!has_all) health_.behind = 0;  // the journal is from before there were copies
  if (health_.is_damaged()) damage_ = journal_report(path, health_);
  opened.read(reader);
  std::vector<Found> joined = opened.contents().records;
  const auto& scans = opened.scans();
  if (std::any_of(scans.begin(), scans.end(), [](auto& scan) { return scan.has_old_records; }))
    convert(joined);
  if (!joined.empty()) next_ = {joined.back().sequence() + 1, joined.back().checksum};
  end_ = encoded_bytes(joined);
  auto scan = scans.begin();
  for_each_copy([&](Copy& copy) { repair(copy, *scan++, joined); });
  if (end_ == 0) copies_.front().file->sync_folder();
  reserve_ahead();
}

Journal::~Journal() {
  for (const Copy& copy : copies_) {
    if (copy.end == end_) discard_partial_record(*copy.file, end_);
  }
}

/// In steps, as each is a change of the file system. Where it has no space left, what is reserved
/// is used up; where it cannot reserve, every record takes its space when it is written.
void Journal::reserve_ahead() {
  if (end_ + kReserveMinBytes <= reserved_) return;
  const std::uint64_t wanted = end_ + kReserveBytes;
  const bool done = std::all_of(copies_.begin(), copies_.end(), [&](const Copy& copy) {
    return copy.file->reserve(end_, wanted) == LockedFile::Reservation::kDone;
  });
  if (done) reserved_ = wanted;
}

/// Leaves an intact file as it is, removes an incomplete record, adds those that the other copy has
/// beyond the end; otherwise writes the file again.
void Journal::repair(Copy& copy, const JournalScan& found, const std::vector<Found>& joined) const {
  const auto common = common_bytes(found, joined);
  if (!common) {
    replace(copy.file, joined, !found.corrupt.empty());
  } else {
    copy.end = copy.synced = *common;
    if (*common < found.bytes) copy.file->truncate(*common);
    if (found.records.size() < joined.size()) {
      Writer(*common).write(std::span(joined).subspan(found.records.size()), *copy.file);
      copy.file->sync();
      copy.file->sync_folder();
    }
  }
  copy.end = copy.synced = end_;
}

/// The new file takes the place of the damaged one in one step, so that a crash loses neither.
void Journal::replace(std::unique_ptr<LockedFile>& file, const std::vector<Found>& joined,
                      bool keep) {
  const fs::path path = file->path();
  auto written = std::make_unique<LockedFile>(with_suffix(path, kNewSuffix));
  written->truncate(0);
  Writer(0).write(joined, *written);
  written->sync();
  if (keep) {
    std::error_code ignored;  // a file system without links keeps no damaged file
    fs::remove(with_suffix(path, kDamagedSuffix), ignored);
    fs::create_hard_link(path, with_suffix(path, kDamagedSuffix), ignored);
  }
  written->rename(path);
  file = std::move(written);
}

/// A record that does not fit must not be begun: taking back its part would give back the space
/// that is reserved for smaller ones.
void Journal::require_space(std::uint64_t end) {
  if (end <= reserved_) return;
  for (const Copy& copy : copies_) {
    if (copy.file->reserve(end_, end) != LockedFile::Reservation::kNoSpace) continue;
    failure_ =
        copy.file->path().string() + ": cannot write: " + std::generic_category().message(ENOSPC);
    throw FileError(failure_);
  }
}

/// Returns whether the work succeeded for every copy; throws the first error if it did for none.
bool Journal::for_each_copy(const std::function<void(Copy&)>& work) {
  std::vector<std::string> failures;
  for (Copy& copy : copies_) {
    try {
      work(copy);
    } catch (const std::runtime_error& failure) {
      failures.emplace_back(failure.what());
    }
  }
  if (failures.empty()) return true;
  failure_ = failures.front();
  if (failures.size() == copies_.size()) throw FileError(failure_);
  return false;
}

/// Writes a record behind all before it.
void Journal::write(Copy& copy, std::span<const std::uint8_t> record) const {
  try {
    if (copy.end == 0 && copy.file->size() > 0) copy.file->truncate(0);
    if (copy.end < end_) catch_up(copy);
    copy.file->write_at(end_, record);
  } catch (const std::runtime_error&) {
    discard_partial_record(*copy.file, copy.end);
    throw;
  }
  copy.end = end_ + record.size();
}

/// Writes what this copy lacks; one copy has all records at any time.
void Journal::catch_up(Copy& copy) const {
  const LockedFile& complete = *std::ranges::max_element(copies_, {}, &Copy::end)->file;
  const MappedFile file(complete.path());
  const auto records = file.bytes().first(end_);
  if (!file.is_readable(records)) throw FileError(complete.path().string() + ": cannot read");
  copy.file->write_at(copy.end, records.subspan(copy.end));
  copy.end = end_;
}

void Journal::append(std::string_view kind, std::span<const std::uint8_t> bytes) {
  const std::vector<std::uint8_t> record = journal_format::write({kind, bytes}, next_);
  require_space(end_ + record.size());
  try {
    if (for_each_copy([&](Copy& copy) { write(copy, record); })) {
      failure_.clear();
    } else {
      reserved_ = 0;  // given back with what a copy has not taken
    }
  } catch (const std::runtime_error&) {
    reserved_ = 0;
    throw;
  }
  end_ += record.size();
  next_ = {next_.sequence + 1, journal_format::checksum_of(record)};
  reserve_ahead();
}

void Journal::clear() {
  for (Copy& copy : copies_) copy.end = copy.synced = 0;
  end_ = 0;
  next_ = {};
  reserved_ = 0;
  for_each_copy([](Copy& copy) { copy.file->truncate(0); });
  reserve_ahead();
}

/// What of a file is on the disk is not known once that failed: it is written again.
void Journal::sync() {
  std::vector<Copy*> failed;
  for_each_copy([&](Copy& copy) {
    failed.push_back(&copy);
    copy.file->sync();
    failed.pop_back();
    copy.synced = copy.end;
  });
  for (Copy* const copy : failed) copy->end = copy->synced;
}

bool is_about_journal(std::string_view line) { return line.find(".journal: ") != line.npos; }

std::string journal_report(const fs::path& path, const JournalHealth& health) {
  const std::string text = text_of(health);
  return text.empty() ? "" : path.filename().string() + ": " + text;
}

}  // namespace adit
