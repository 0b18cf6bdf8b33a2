// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/volume_map/volume_record.hpp"

#include <cstring>
#include <type_traits>
#include <utility>

#include <zlib.h>

namespace adit {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::uint64_t kBytesMax = 500'000'000;  // of an uncompressed record

class Writer {
 public:
  template <class T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    const auto* begin = reinterpret_cast<const std::uint8_t*>(&value);
    bytes_.insert(bytes_.end(), begin, begin + sizeof(T));
  }
  void put_pose(const LevelPose& pose) {
    const auto& [plan, z_m] = pose;
    for (const double number : {plan.x, plan.y, plan.theta, z_m}) put(number);
  }
  /// Byte planes: the first bytes of all words first. Neighbours have similar bytes, which
  /// compresses better.
  void put_planes(const std::vector<std::uint32_t>& words) {
    put(static_cast<std::uint64_t>(words.size()));
    for (unsigned shift = 0; shift < 32; shift += 8) {
      for (const std::uint32_t word : words) put(static_cast<std::uint8_t>(word >> shift));
    }
  }
  void put_bytes(const Bytes& bytes) {
    put(static_cast<std::uint64_t>(bytes.size()));
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  }
  Bytes take() { return std::move(bytes_); }

 private:
  Bytes bytes_;
};

/// Returns zeros after the end, and is then not valid.
class Reader {
 public:
  explicit Reader(const Bytes& bytes) : bytes_(bytes) {}

  template <class T>
  T get() {
    T value{};
    if (!has(sizeof(T))) return value;
    std::memcpy(&value, bytes_.data() + at_, sizeof(T));
    at_ += sizeof(T);
    return value;
  }
  LevelPose get_pose() {
    const auto x = get<double>();
    const auto y = get<double>();
    const auto theta = get<double>();
    return {{x, y, theta}, get<double>()};
  }
  std::vector<std::uint32_t> get_planes() {
    const auto n = get<std::uint64_t>();
    if (n > kBytesMax || !has(4 * n)) return {};
    std::vector<std::uint32_t> words(n);
    for (unsigned shift = 0; shift < 32; shift += 8) {
      for (std::uint32_t& word : words) word |= std::uint32_t{get<std::uint8_t>()} << shift;
    }
    return words;
  }
  Bytes get_bytes() {
    const auto n = get<std::uint64_t>();
    if (n > kBytesMax || !has(n)) return {};
    const auto begin = bytes_.begin() + static_cast<std::ptrdiff_t>(at_);
    at_ += n;
    return {begin, begin + static_cast<std::ptrdiff_t>(n)};
  }
  [[nodiscard]] bool valid() const { return valid_ && at_ == bytes_.size(); }

 private:
  bool has(std::uint64_t n) {
    valid_ = valid_ && bytes_.size() - at_ >= n;
    return valid_;
  }

  const Bytes& bytes_;
  std::size_t at_ = 0;
  bool valid_ = true;
};

std::uint32_t word_of(float number) {
  std::uint32_t word = 0;
  std::memcpy(&word, &number, sizeof word);
  return word;
}

float number_of(std::uint32_t word) {
  float number = 0.0F;
  std::memcpy(&number, &word, sizeof number);
  return number;
}

void put_points(const std::vector<VolumePoint>& points, Writer& writer) {
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<std::uint32_t> words;
    for (const VolumePoint& point : points) words.push_back(word_of(point.p_volume[axis]));
    writer.put_planes(words);
  }
  std::vector<std::uint32_t> scans;
  for (const VolumePoint& point : points) scans.push_back(static_cast<std::uint32_t>(point.scan));
  writer.put_planes(scans);
}

bool get_points(Reader& reader, std::vector<VolumePoint>& points) {
  const auto x = reader.get_planes();
  const auto y = reader.get_planes();
  const auto z = reader.get_planes();
  const auto scans = reader.get_planes();
  if (y.size() != x.size() || z.size() != x.size() || scans.size() != x.size()) return false;
  for (std::size_t i = 0; i < x.size(); ++i) {
    points.push_back(
        {{number_of(x[i]), number_of(y[i]), number_of(z[i])}, static_cast<std::int32_t>(scans[i])});
  }
  return true;
}

}  // namespace

std::vector<std::uint8_t> to_bytes(const VolumeRecord& record) {
  const auto& [contents, T_odom_volume, anchor, T_volume_viewpoint] = record.volume;
  Writer writer;
  writer.put(static_cast<std::int32_t>(record.id));
  writer.put(static_cast<std::int32_t>(anchor ? anchor->local_map : -1));
  writer.put_pose(anchor ? anchor->T_local_volume : LevelPose{});
  writer.put_pose(T_odom_volume);
  writer.put_pose(T_volume_viewpoint);
  writer.put(contents.cell_m);
  writer.put(contents.utime);
  writer.put(static_cast<std::int32_t>(contents.scans));
  writer.put(contents.rejected_points);
  writer.put_bytes(contents.octree);
  writer.put(static_cast<std::uint64_t>(record.first_point));
  put_points(contents.points, writer);
  const Bytes plain = writer.take();
  Writer packed;
  packed.put(static_cast<std::uint64_t>(plain.size()));
  Bytes bytes = packed.take();
  auto length = compressBound(plain.size());
  bytes.resize(sizeof(std::uint64_t) + length);
  compress2(bytes.data() + sizeof(std::uint64_t), &length, plain.data(), plain.size(), 1);
  bytes.resize(sizeof(std::uint64_t) + length);
  return bytes;
}

std::optional<VolumeRecord> volume_record_from(std::span<const std::uint8_t> bytes) {
  std::uint64_t plain_bytes = 0;
  if (bytes.size() < sizeof plain_bytes) return std::nullopt;
  std::memcpy(&plain_bytes, bytes.data(), sizeof plain_bytes);
  if (plain_bytes > kBytesMax) return std::nullopt;
  Bytes plain(plain_bytes);
  uLongf length = plain_bytes;
  const auto packed = bytes.subspan(sizeof plain_bytes);
  if (uncompress(plain.data(), &length, packed.data(), packed.size()) != Z_OK) return std::nullopt;
  if (length != plain_bytes) return std::nullopt;

  Reader reader(plain);
  VolumeRecord record;
  auto& [contents, T_odom_volume, anchor, T_volume_viewpoint] = record.volume;
  record.id = reader.get<std::int32_t>();
  const auto local_map = reader.get<std::int32_t>();
  const LevelPose T_local_volume = reader.get_pose();
  if (local_map >= 0) anchor = {local_map, T_local_volume};
  T_odom_volume = reader.get_pose();
  T_volume_viewpoint = reader.get_pose();
  contents.cell_m = reader.get<double>();
  contents.utime = reader.get<std::int64_t>();
  contents.scans = reader.get<std::int32_t>();
  contents.rejected_points = reader.get<std::int64_t>();
  contents.octree = reader.get_bytes();
  record.first_point = reader.get<std::uint64_t>();
  if (!get_points(reader, contents.points) || !reader.valid() || record.id < 0) return std::nullopt;
  return record;
}

}  // namespace adit
