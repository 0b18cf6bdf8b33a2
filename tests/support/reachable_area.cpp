// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/reachable_area.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>

#include "common/geometry/pose2.hpp"
#include "sim/world/plan/tunnel_line.hpp"
#include "tests/support/passable_raster.hpp"

namespace adit {
namespace {

Footprint footprint(const Vehicle& vehicle, const Pose2& T_cell_body) {
  constexpr double kSpacing = PassableRaster::kSide;
  const int along = static_cast<int>(std::ceil(vehicle.length_m / kSpacing));
  const int across = static_cast<int>(std::ceil(vehicle.width_m / kSpacing));
  Footprint squares;
  for (int i = 0; i <= along; ++i) {
    for (int j = 0; j <= across; ++j) {
      const Eigen::Vector2d p_body(vehicle.length_m * (static_cast<double>(i) / along - 0.5),
                                   vehicle.width_m * (static_cast<double>(j) / across - 0.5));
      const Eigen::Vector2d place = T_cell_body * p_body / PassableRaster::kSide;
      squares.push_back(
          {static_cast<int>(std::floor(place.x())), static_cast<int>(std::floor(place.y()))});
    }
  }
  std::sort(squares.begin(), squares.end());
  squares.erase(std::unique(squares.begin(), squares.end()), squares.end());
  return squares;
}

}  // namespace

std::vector<Footprint> footprints(const Vehicle& vehicle, double heading_rad, double cell_m) {
  const std::array<double, 3> shifts{0.0, -cell_m / 3.0, cell_m / 3.0};
  constexpr std::array<double, 3> kTurns{0.0, -0.14, 0.14};  // headings are 0.46 rad apart at most
  std::vector<Footprint> result;
  for (const double turn : kTurns) {
    for (const double x : shifts) {
      for (const double y : shifts) {
        result.push_back(
            footprint(vehicle, {cell_m / 2.0 + x, cell_m / 2.0 + y, heading_rad + turn}));
      }
    }
  }
  return result;
}

namespace {

constexpr int kHeadings = 16;
constexpr int kSquaresPerCell = 2;
static_assert(kSquaresPerCell * PassableRaster::kSide == ReachableArea::kSide);

/// A move to a nearby cell. Headings are the directions of the moves, so that each ends in a cell.
struct Move {
  int columns;
  int rows;

  [[nodiscard]] double heading_rad() const { return std::atan2(rows, columns); }
};
constexpr std::array<Move, kHeadings> kMoves{{{1, 0},
                                              {2, 1},
                                              {1, 1},
                                              {1, 2},
                                              {0, 1},
                                              {-1, 2},
                                              {-1, 1},
                                              {-2, 1},
                                              {-1, 0},
                                              {-2, -1},
                                              {-1, -1},
                                              {-1, -2},
                                              {0, -1},
                                              {1, -2},
                                              {1, -1},
                                              {2, -1}}};

struct State {
  int column = 0;
  int row = 0;
  int heading = 0;
  std::size_t level = 0;  ///< index
};

/// Heights of the bare floor in the middle of the squares of a raster.
class FloorGrid {
 public:
  FloorGrid(const WorldTruth& truth, int level, const PassableRaster& raster)
      : truth_(truth),
        level_(level),
        raster_(raster),
        heights_(
            static_cast<std::size_t>(raster.columns()) * static_cast<std::size_t>(raster.rows()),
            kUnknown) {}

  /// NaN where there is no floor.
  double at(int column, int row) {
    if (column < 0 || row < 0 || column >= raster_.columns() || row >= raster_.rows()) return kNone;
    float& height =
        heights_[static_cast<std::size_t>(row) * static_cast<std::size_t>(raster_.columns()) +
                 static_cast<std::size_t>(column)];
    if (height == kUnknown) {
      const Eigen::Vector2d middle =
          raster_.origin() + PassableRaster::kSide * Eigen::Vector2d(column + 0.5, row + 0.5);
      height = static_cast<float>(truth_.floor_at(middle, level_).value_or(kNone));
    }
    return height;
  }

 private:
  static constexpr float kUnknown = -1e30F;
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  const WorldTruth& truth_;
  int level_;
  const PassableRaster& raster_;
  std::vector<float> heights_;
};

/// Decides by the floor under its wheels whether a vehicle stands. Where there is no floor, it
/// decides nothing.
class Standing {
 public:
  Standing(const Vehicle& vehicle, double slope_max_rad)
      : vehicle_(vehicle), grade_max_(std::tan(slope_max_rad)) {}

  /// `p` is the middle of the vehicle in squares of the grid.
  [[nodiscard]] bool is_safe(const Eigen::Vector2d& p, double heading_rad, FloorGrid& floor) const {
    std::array<double, 4> height_m{};
    for (std::size_t i = 0; i < 4; ++i) {
      const Eigen::Vector2d p_body((i < 2 ? 0.5 : -0.5) * vehicle_.wheelbase_m,
                                   (i % 2 == 0 ? 0.5 : -0.5) * vehicle_.track_m);
      const Eigen::Vector2d wheel =
          p + Pose2{0.0, 0.0, heading_rad} * p_body / PassableRaster::kSide;
      const int column = static_cast<int>(std::floor(wheel.x()));
      const int row = static_cast<int>(std::floor(wheel.y()));
      height_m[i] = floor.at(column, row);
      if (is_at_step(column, row, floor)) return false;
    }
    const auto& [fl, fr, rl, rr] = height_m;
    const double along = (fl + fr - rl - rr) / (2.0 * vehicle_.wheelbase_m);
    const double across = (fl + rl - fr - rr) / (2.0 * vehicle_.track_m);
    return !(std::hypot(along, across) > grade_max_);
  }

 private:
  /// A change of height over two squares. Moves are shorter than the stretch, so that none passes
  /// over a step.
  [[nodiscard]] bool is_at_step(int column, int row, FloorGrid& floor) const {
    constexpr int kReach = 3;
    for (int i = -kReach; i + 2 <= kReach; ++i) {
      const double in_x = floor.at(column + i + 2, row) - floor.at(column + i, row);
      const double in_y = floor.at(column, row + i + 2) - floor.at(column, row + i);
      if (std::abs(in_x) > vehicle_.step_max_m || std::abs(in_y) > vehicle_.step_max_m) return true;
    }
    return false;
  }

  Vehicle vehicle_;
  double grade_max_;
};

/// One level of a mine, and which of its states are reached.
struct FloodLevel {
  FloodLevel(const WorldTruth& truth, const Vehicle& vehicle, int level_number)
      : number(level_number),
        raster(truth, vehicle, level_number),
        floor(truth, level_number, raster) {}
  FloodLevel(const FloodLevel&) = delete;
  FloodLevel& operator=(const FloodLevel&) = delete;

  int number;
  PassableRaster raster;
  FloorGrid floor;
  std::vector<std::uint16_t> reached = {};  ///< of each cell, one bit per heading
  std::vector<std::uint16_t> checked = {};  ///< states whose fit was checked, likewise
};

/// Flood fill over levels, cells and headings.
class Flood {
 public:
  Flood(const World& world, const Vehicle& vehicle, double slope_max_rad)
      : standing_(vehicle, slope_max_rad) {
    for (const int level : world.truth.levels) {
      levels_.push_back(std::make_unique<FloodLevel>(world.truth, vehicle, level));
      if (level == world.start_level) start_level_ = levels_.size() - 1;
    }
    columns_ = (raster().columns() + kSquaresPerCell - 1) / kSquaresPerCell;
    rows_ = (raster().rows() + kSquaresPerCell - 1) / kSquaresPerCell;
    for (auto& level : levels_) {
      level->reached.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
      level->checked.resize(level->reached.size());
    }
    for (std::size_t i = 0; i < kHeadings; ++i) {
      footprints_[i] = footprints(vehicle, kMoves[i].heading_rad(), ReachableArea::kSide);
    }
  }

  void run(const Pose2& T_world_start) {
    std::vector<State> open;
    add(nearest(T_world_start), open);
    while (!open.empty()) {
      const State state = open.back();
      open.pop_back();
      for (const int turn : {-1, 0, 1}) {
        const int heading = (state.heading + turn + kHeadings) % kHeadings;
        add_moves(state, heading, kMoves[static_cast<std::size_t>(state.heading)], open);
        add_moves(state, heading, kMoves[static_cast<std::size_t>(heading)], open);
      }
      add_other_levels(state, open);
    }
  }

  void take_cells(ReachableArea& area) const {
    for (const auto& level : levels_) {
      for (int row = 0; row < rows_; ++row) {
        for (int column = 0; column < columns_; ++column) {
          if (level->reached[index(column, row)] == 0) continue;
          area.cells.emplace_back(raster().origin() +
                                  ReachableArea::kSide * Eigen::Vector2d(column + 0.5, row + 0.5));
          area.levels.push_back(level->number);
        }
      }
    }
  }

  [[nodiscard]] bool is_reached(const Eigen::Vector2d& p_world, int level_number) const {
    const Eigen::Vector2d place = (p_world - raster().origin()) / ReachableArea::kSide;
    if (!is_within(place)) return false;
    const std::size_t cell = index(static_cast<int>(place.x()), static_cast<int>(place.y()));
    return std::any_of(levels_.begin(), levels_.end(), [&](const auto& level) {
      return level->number == level_number && level->reached[cell] != 0;
    });
  }

 private:
  [[nodiscard]] const PassableRaster& raster() const { return levels_.front()->raster; }
  [[nodiscard]] bool is_within(const Eigen::Vector2d& place) const {
    return place.x() >= 0.0 && place.y() >= 0.0 && place.x() < columns_ && place.y() < rows_;
  }
  [[nodiscard]] std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }

  /// The state nearest to a pose; cell (-1, -1) for a pose outside of the raster.
  [[nodiscard]] State nearest(const Pose2& T_world_body) const {
    const Eigen::Vector2d place =
        (T_world_body.translation() - raster().origin()) / ReachableArea::kSide;
    if (!is_within(place)) return {-1, -1, 0, 0};
    const auto off = [&](const Move& move) {
      return std::abs(angle_diff(move.heading_rad(), T_world_body.theta));
    };
    const auto* best =
        std::min_element(kMoves.begin(), kMoves.end(),
                         [&](const Move& a, const Move& b) { return off(a) < off(b); });
    return {static_cast<int>(place.x()), static_cast<int>(place.y()),
            static_cast<int>(best - kMoves.begin()), start_level_};
  }

  /// Adds the move forwards and in reverse.
  void add_moves(const State& from, int heading, const Move& move, std::vector<State>& open) {
    add({from.column + move.columns, from.row + move.rows, heading, from.level}, open);
    add({from.column - move.columns, from.row - move.rows, heading, from.level}, open);
  }

  /// Adds the same state on the levels that have the same floor there.
  void add_other_levels(const State& state, std::vector<State>& open) {
    constexpr double kSameM = 0.05;
    for (std::size_t level = 0; level < levels_.size(); ++level) {
      if (level == state.level) continue;
      const double here_m = floor_m(state, state.level);
      if (std::abs(floor_m(state, level) - here_m) > kSameM) continue;
      add({state.column, state.row, state.heading, level}, open);
    }
  }

  /// Height of the floor of a level at a cell; NaN without.
  [[nodiscard]] double floor_m(const State& state, std::size_t level) {
    return levels_[level]->floor.at(kSquaresPerCell * state.column, kSquaresPerCell * state.row);
  }

  void add(const State& state, std::vector<State>& open) {
    if (state.column < 0 || state.row < 0 || state.column >= columns_ || state.row >= rows_) return;
    FloodLevel& level = *levels_[state.level];
    const std::size_t cell = index(state.column, state.row);
    const auto bit = static_cast<std::uint16_t>(1U << static_cast<unsigned>(state.heading));
    if ((level.checked[cell] & bit) != 0) return;
    level.checked[cell] |= bit;
    if (!fits(state, level)) return;
    level.reached[cell] |= bit;
    open.push_back(state);
  }

  [[nodiscard]] bool fits(const State& state, FloodLevel& level) {
    const std::vector<Footprint>& poses = footprints_[static_cast<std::size_t>(state.heading)];
    const bool has_room = std::any_of(poses.begin(), poses.end(), [&](const Footprint& squares) {
      return std::all_of(squares.begin(), squares.end(), [&](const std::array<int, 2>& square) {
        return level.raster.at(state.column * kSquaresPerCell + square[0],
                               state.row * kSquaresPerCell + square[1]);
      });
    });
    const Eigen::Vector2d middle(kSquaresPerCell * (state.column + 0.5),
                                 kSquaresPerCell * (state.row + 0.5));
    return has_room &&
           standing_.is_safe(middle, kMoves[static_cast<std::size_t>(state.heading)].heading_rad(),
                             level.floor);
  }

  Standing standing_;
  std::vector<std::unique_ptr<FloodLevel>> levels_;
  std::size_t start_level_ = 0;
  int columns_ = 0;
  int rows_ = 0;
  std::array<std::vector<Footprint>, kHeadings> footprints_;
};

/// Length of the steps along the edge for which a position across its width is reached.
double reached_length_m(const TunnelEdge& edge, const Flood& flood) {
  const TunnelLine line{edge.tunnel, edge.points, edge.width_m, false};
  const int steps = std::max(1, static_cast<int>(std::ceil(edge.length_m / ReachableArea::kSide)));
  const int across = static_cast<int>(std::ceil(edge.width_m / ReachableArea::kSide));
  int reached = 0;
  for (int i = 0; i < steps; ++i) {
    for (int j = 0; j <= across; ++j) {
      const Eigen::Vector2d p = line.beside(edge.length_m * (i + 0.5) / steps,
                                            edge.width_m * (static_cast<double>(j) / across - 0.5));
      if (!flood.is_reached(p, edge.level)) continue;
      ++reached;
      break;
    }
  }
  return edge.length_m * reached / steps;
}

}  // namespace

ReachableArea reachable_area(const World& world, const Vehicle& vehicle, double slope_max_rad) {
  Flood flood(world, vehicle, slope_max_rad);
  flood.run(world.T_world_start);
  ReachableArea area;
  flood.take_cells(area);
  area.area_m2 =
      static_cast<double>(area.cells.size()) * ReachableArea::kSide * ReachableArea::kSide;
  for (const TunnelEdge& edge : world.truth.tunnels.edges) {
    area.edge_length_m.push_back(reached_length_m(edge, flood));
  }
  return area;
}

}  // namespace adit
