// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/loop_closure/wall_store.hpp"

#include <span>
#include <tuple>
#include <type_traits>
#include <utility>

#include "common/files/raw_bytes.hpp"

namespace adit {
namespace {

std::size_t bytes_of_walls(const LocalWalls& walls) {
  std::size_t bytes = sizeof(LocalWalls) + walls.points.size() * sizeof(SurfacePoint) +
                      walls.path.size() * sizeof(TraversedPoint);
  for (const LocalWalls::View& view : walls.views) {
    bytes += sizeof(view) +
             std::get<const std::vector<float>&>(view.free_space.fields()).size() * sizeof(float);
  }
  return bytes;
}

/// What differs between the points of walls, see local_walls.
template <class Point>
auto fields_of(Point& point) {
  return std::tie(point.p.x(), point.p.y(), point.z_m, point.normal.x(), point.normal.y(),
                  point.normal_variance, point.variance);
}

template <class Fields>
void put_fields(const Fields& fields, RawWriter& bytes) {
  const auto put = [&]<class T>(const T& field) {
    if constexpr (std::is_same_v<T, std::vector<float>>) {
      bytes.put_all(field);
    } else {
      bytes.put(field);
    }
  };
  std::apply([&](const auto&... field) { (put(field), ...); }, fields);
}

template <class Fields>
void take_fields(RawReader& bytes, const Fields& fields) {
  const auto take = [&]<class T>(T& field) {
    if constexpr (std::is_same_v<T, std::vector<float>>) {
      field = bytes.take_all<T>();
    } else {
      field = bytes.take<T>();
    }
  };
  std::apply([&](auto&... field) { (take(field), ...); }, fields);
}

std::vector<std::uint8_t> stored(const LocalWalls& walls) {
  RawWriter bytes;
  bytes.put(walls.length_m);
  bytes.put(walls.points.size());
  for (const SurfacePoint& point : walls.points) put_fields(fields_of(point), bytes);
  bytes.put(walls.views.size());
  for (const LocalWalls::View& view : walls.views) {
    put_fields(view.free_space.fields(), bytes);
    bytes.put(view.T_local_body);
  }
  return bytes.bytes();
}

/// All but the path.
LocalWalls restored(std::span<const std::uint8_t> stored) {
  RawReader bytes(stored);
  LocalWalls walls;
  walls.length_m = bytes.take<double>();
  walls.points.resize(bytes.take<std::size_t>());
  for (SurfacePoint& point : walls.points) take_fields(bytes, fields_of(point));
  walls.views.resize(bytes.take<std::size_t>());
  for (LocalWalls::View& view : walls.views) {
    take_fields(bytes, view.free_space.fields());
    view.T_local_body = bytes.take<Pose2>();
  }
  return walls;
}

}  // namespace

WallStore::WallStore(const std::filesystem::path& folder, std::size_t bytes_in_memory)
    : bytes_in_memory_(bytes_in_memory) {
  if (!folder.empty()) file_.emplace(folder);
}

void WallStore::push_back(LocalWalls walls) {
  const auto shared = std::make_shared<const LocalWalls>(std::move(walls));
  Entry entry;
  if (file_) {
    entry.path = std::make_shared<const std::vector<TraversedPoint>>(shared->path);
    entry.offset = file_->append(stored(*shared));
  } else {
    entry.path = {shared, &shared->path};
  }
  entries_.push_back(std::move(entry));
  keep(size() - 1, shared);
}

void WallStore::pop_back() {
  drop(size() - 1);
  if (file_) file_->truncate(entries_.back().offset);
  entries_.pop_back();
}

std::shared_ptr<const LocalWalls> WallStore::operator[](std::size_t i) const {
  const Entry& entry = entries_[i];
  if (entry.used) {
    used_.splice(used_.begin(), used_, *entry.used);
    return entry.kept;
  }
  Walls walls = entry.held.lock();
  if (!walls) walls = read(i);
  keep(i, walls);
  return walls;
}

WallStore::Walls WallStore::read(std::size_t i) const {
  const std::uint64_t end = i + 1 < size() ? entries_[i + 1].offset : file_->size();
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(end - entries_[i].offset));
  file_->read(entries_[i].offset, bytes);
  LocalWalls walls = restored(bytes);
  walls.path = path(i);
  return std::make_shared<const LocalWalls>(std::move(walls));
}

void WallStore::keep(std::size_t i, Walls walls) const {
  const Entry& entry = entries_[i];
  bytes_kept_ += bytes_of_walls(*walls);
  entry.held = walls;
  entry.kept = std::move(walls);
  entry.used = used_.insert(used_.begin(), i);
  while (file_ && bytes_kept_ > bytes_in_memory_ && used_.size() > 1) drop(used_.back());
}

void WallStore::drop(std::size_t i) const {
  const Entry& entry = entries_[i];
  if (!entry.used) return;
  bytes_kept_ -= bytes_of_walls(*entry.kept);
  used_.erase(*entry.used);
  entry.used.reset();
  entry.kept.reset();
}

}  // namespace adit
