// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/files/las_file.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string_view>

#include <fmt/format.h>

#include "common/bus/node/version.hpp"
#include "common/files/file_error.hpp"
#include "common/files/output_file.hpp"

namespace adit {
namespace {

static_assert(std::endian::native == std::endian::little, "LAS is written in memory order");

constexpr double kScaleM = 0.001;
constexpr std::uint16_t kHeaderBytes = 375;
constexpr std::uint16_t kExtraBytes = 12;
constexpr std::uint16_t kPointBytes = 30 + kExtraBytes;
constexpr std::uint8_t kPointFormat = 6;
constexpr std::uint16_t kGpsStandardTime = 1U << 0U;  // global encoding
constexpr std::uint16_t kWktCrs = 1U << 4U;
constexpr std::size_t kChunkBytes = 1 << 20;

/// The begins of days after a leap second since the epoch of GPS, 1980-01-06, as UNIX time [s].
constexpr std::array<std::int64_t, 18> kLeapSeconds{
    362793600, 394329600,  425865600,  489024000,  567993600,  631152000,
    662688000, 709948800,  741484800,  773020800,  820454400,  867715200,
    915148800, 1136073600, 1230768000, 1341100800, 1435708800, 1483228800};

/// Bytes in the order of a file.
class Bytes {
 public:
  template <class T>
  void add(T value) {
    text_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  /// Padded with zeros, or cut, to a size.
  void add_text(std::string_view text, std::size_t bytes) {
    text_.append(text.substr(0, bytes));
    text_.append(bytes - std::min(bytes, text.size()), '\0');
  }
  void add_zeros(std::size_t bytes) { text_.append(bytes, '\0'); }

  [[nodiscard]] const std::string& text() const { return text_; }
  void clear() { text_.clear(); }

 private:
  std::string text_;
};

/// What the header tells of the points.
struct Extent {
  std::uint64_t points = 0;
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d high = -low;
  std::int64_t last_utime = 0;

  [[nodiscard]] Eigen::Vector3d offset() const {
    return points == 0 ? Eigen::Vector3d(0.0, 0.0, 0.0) : Eigen::Vector3d(low.array().floor());
  }
  /// In units of kScaleM from the offset.
  [[nodiscard]] Eigen::Array3d scaled(const Eigen::Vector3d& p) const {
    return ((p - offset()) / kScaleM).array().round();
  }
  [[nodiscard]] Eigen::Vector3d as_stored(const Eigen::Vector3d& p) const {
    return points == 0 ? p : Eigen::Vector3d(offset() + kScaleM * scaled(p).matrix());
  }
};

Extent extent_of(const LasPoints& points) {
  Extent extent;
  points([&](const LasPoint& point) {
    ++extent.points;
    extent.low = extent.low.cwiseMin(point.p);
    extent.high = extent.high.cwiseMax(point.p);
    extent.last_utime = std::max(extent.last_utime, point.utime);
  });
  if (extent.points == 0) extent.low = extent.high = Eigen::Vector3d::Zero();
  return extent;
}

/// A variable length record.
void add_record(Bytes& bytes, std::string_view user, std::uint16_t id, std::string_view description,
                std::string_view data) {
  bytes.add<std::uint16_t>(0);
  bytes.add_text(user, 16);
  bytes.add(id);
  bytes.add(static_cast<std::uint16_t>(data.size()));
  bytes.add_text(description, 32);
  bytes.add_text(data, data.size());
}

/// The description of an attribute in the extra bytes of a point.
void add_attribute(Bytes& bytes, std::uint8_t type, std::string_view name,
                   std::string_view description) {
  bytes.add_zeros(2);
  bytes.add(type);
  bytes.add<std::uint8_t>(0);  // no minimum, maximum, scale, offset
  bytes.add_text(name, 32);
  bytes.add_zeros(4 + 24 + 24 + 24 + 24 + 24);
  bytes.add_text(description, 32);
}

std::string records(const std::string& crs_wkt1) {
  constexpr std::uint8_t kUnsignedLong = 5;
  constexpr std::uint8_t kFloat = 9;
  Bytes attributes;
  add_attribute(attributes, kUnsignedLong, "scan", "number of the 3D scan");
  add_attribute(attributes, kFloat, "sd_plan", "standard deviation in plan [m]");
  add_attribute(attributes, kFloat, "sd_z", "standard deviation in z [m]");
  Bytes bytes;
  std::string wkt = crs_wkt1;
  wkt.push_back('\0');
  add_record(bytes, "LASF_Projection", 2112, "coordinate system, WKT", wkt);
  add_record(bytes, "LASF_Spec", 4, "extra bytes", attributes.text());
  return bytes.text();
}

std::string header(const Extent& extent, std::size_t records_bytes) {
  using std::chrono::floor;
  const std::chrono::sys_time<std::chrono::microseconds> last{
      std::chrono::microseconds(extent.last_utime)};
  const std::chrono::year_month_day day(floor<std::chrono::days>(last));
  const auto new_year = std::chrono::sys_days(day.year() / std::chrono::January / 1);
  const auto day_of_year = (floor<std::chrono::days>(last) - new_year).count() + 1;
  Bytes bytes;
  bytes.add_text("LASF", 4);
  bytes.add<std::uint16_t>(0);  // file source
  bytes.add<std::uint16_t>(kGpsStandardTime | kWktCrs);
  bytes.add_zeros(16);  // project
  bytes.add<std::uint8_t>(1);
  bytes.add<std::uint8_t>(4);
  bytes.add_text("MERGE", 32);
  bytes.add_text(fmt::format("adit survey {}", version()), 32);
  bytes.add(static_cast<std::uint16_t>(day_of_year));
  bytes.add(static_cast<std::uint16_t>(static_cast<int>(day.year())));
  bytes.add(kHeaderBytes);
  bytes.add(static_cast<std::uint32_t>(kHeaderBytes + records_bytes));
  bytes.add<std::uint32_t>(2);  // records
  bytes.add(kPointFormat);
  bytes.add(kPointBytes);
  bytes.add_zeros(4 + 5 * 4);  // counts of LAS 1.0 to 1.3: unused by formats 6 and above
  for (int i = 0; i < 3; ++i) bytes.add(kScaleM);
  for (const double offset : extent.offset()) bytes.add(offset);
  const Eigen::Vector3d high = extent.as_stored(extent.high);
  const Eigen::Vector3d low = extent.as_stored(extent.low);
  for (int i = 0; i < 3; ++i) {
    bytes.add(high[i]);
    bytes.add(low[i]);
  }
  bytes.add_zeros(8 + 8 + 4);  // waveforms, extended records
  bytes.add(extent.points);
  bytes.add(extent.points);  // of first returns
  bytes.add_zeros(14 * 8);   // of later ones
  return bytes.text();
}

void add_point(const LasPoint& point, const Extent& extent, Bytes& bytes) {
  const Eigen::Array3d scaled = extent.scaled(point.p);
  for (int i = 0; i < 3; ++i) bytes.add(static_cast<std::int32_t>(scaled[i]));
  bytes.add<std::uint16_t>(0);    // intensity
  bytes.add<std::uint8_t>(0x11);  // return 1 of 1
  bytes.add<std::uint8_t>(0);     // flags
  bytes.add<std::uint8_t>(1);     // unclassified
  bytes.add<std::uint8_t>(0);     // user data
  bytes.add<std::int16_t>(0);     // scan angle
  bytes.add(static_cast<std::uint16_t>(std::min<std::uint32_t>(point.scan, 0xFFFFU)));
  bytes.add(adjusted_gps_time(point.utime));
  bytes.add(point.scan);
  bytes.add(point.plan_sd_m);
  bytes.add(point.z_sd_m);
}

}  // namespace

double adjusted_gps_time(std::int64_t utime) {
  constexpr std::int64_t kGpsEpochS = 315964800;
  const auto leaps =
      std::ranges::upper_bound(kLeapSeconds, utime / 1'000'000) - kLeapSeconds.begin();
  return static_cast<double>(utime - (kGpsEpochS - leaps + 1'000'000'000) * 1'000'000) * 1e-6;
}

void write_las(const LasPoints& points, const std::string& crs_wkt1,
               const std::filesystem::path& path) {
  const Extent extent = extent_of(points);
  constexpr double kSizeMaxM = 2e6;
  if ((extent.high - extent.low).maxCoeff() > kSizeMaxM)
    throw FileError(fmt::format("cannot write {}: its points are too far apart", path.string()));
  OutputFile file(path);
  const std::string variable = records(crs_wkt1);
  file.write(header(extent, variable.size()));
  file.write(variable);
  Bytes bytes;
  points([&](const LasPoint& point) {
    add_point(point, extent, bytes);
    if (bytes.text().size() < kChunkBytes) return;
    file.write(bytes.text());
    bytes.clear();
  });
  file.write(bytes.text());
  file.close();
}

}  // namespace adit
