// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/input/cloud_store.hpp"

#include <utility>

#include "common/files/raw_bytes.hpp"

namespace adit {

void CloudStore::push_back(Cloud cloud) {
  RawWriter bytes;
  bytes.put(cloud.lines.size());
  for (const CloudLine& line : cloud.lines) {
    bytes.put(line.utime);
    bytes.put(line.origin.x());
    bytes.put(line.origin.y());
    bytes.put(line.origin.z());
    bytes.put(line.points.size());
    for (const Eigen::Vector3f& p : line.points) {
      bytes.put(p.x());
      bytes.put(p.y());
      bytes.put(p.z());
    }
  }
  offsets_.push_back(lines_.append(bytes.bytes()));
  points_.push_back(cloud.points());
  std::vector<CloudLine> first;
  if (!cloud.lines.empty())
    first.push_back({cloud.lines.front().utime, cloud.lines.front().origin, {}, {}});
  cloud.lines = std::move(first);
  clouds_.push_back(std::move(cloud));
}

std::vector<CloudLine> CloudStore::lines(std::size_t i) const {
  const std::uint64_t end = i + 1 < offsets_.size() ? offsets_[i + 1] : lines_.size();
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(end - offsets_[i]));
  lines_.read(offsets_[i], bytes);
  RawReader reader(bytes);
  const auto take_vector = [&reader] {
    const auto x = reader.take<float>();
    const auto y = reader.take<float>();
    return Eigen::Vector3f(x, y, reader.take<float>());
  };
  std::vector<CloudLine> lines(reader.take<std::size_t>());
  for (CloudLine& line : lines) {
    line.utime = reader.take<std::int64_t>();
    line.origin = take_vector();
    line.points.resize(reader.take<std::size_t>());
    for (Eigen::Vector3f& p : line.points) p = take_vector();
  }
  return lines;
}

}  // namespace adit
