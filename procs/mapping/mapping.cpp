// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/mapping.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "common/sensing/seconds.hpp"
#include "procs/mapping/common_scale_error.hpp"

namespace adit {
namespace {

// Half-width of the search around each older map for a body that may be anywhere: local maps follow
// each other every few metres [m].
constexpr double kSearchM = 1.0;
constexpr std::size_t kRelocalisations = 3;
constexpr int kMapsAfterGap = 3;  // that are searched before it
// The number of newest maps whose likelihood is monitored.
constexpr int kMapsMonitored = 4;
// Of older maps, contradictions that a revision may remove.
constexpr std::size_t kContradictionsMonitored = 8;
// Share of its walls that a local map has in common with others if it shows nothing new.
constexpr double kRedundantShare = 0.98;
// Of two local maps, −2 log-likelihood ratio: as the gate of a loop closure. Right maps of public
// logs reach 12, wrong ones mostly more than 40.
constexpr double kContradiction = 21.1;
// Tolerated error of the estimated pose of a map, for its inconsistency.
const Eigen::Vector3d kInconsistencySd(0.2, 0.2, 0.02);

// Share of the covariance of a displacement that the mean of what was seen along it has, if the
// error is a random walk and the walls are seen evenly.
constexpr double kDeformationShare = 1.0 / 3.0;
// A body that rests near home is localised by what it saw over this last distance.
constexpr double kSeenAtRestM = 1.0;
constexpr double kRestS = 2.0;  // without a stored scan
constexpr double kNearHomeM = 5.0;
constexpr double kBesideM = 5.0;   // walls farther beside a map than this are not its own
constexpr double kSureSdM = 0.05;  // a smaller standard deviation needs no improvement

/// Of (x, y, θ).
Eigen::Matrix3d rotation_of(double angle_rad) {
  return Eigen::AngleAxisd(angle_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

bool begins_session(const LocalMap& map, const LocalMapStore& before) {
  return !before.empty() && before.back().session != map.session;
}

/// If the body may have been carried, the view from one place is too small to localise it.
LocalMapBuilderParams builder_params(const MappingParams& params) {
  LocalMapBuilderParams builder = params.local_maps;
  if (params.carried) builder.first_s = 0.0;
  return builder;
}

CloudMatchingParams cloud_params(const MappingParams& params) {
  CloudMatchingParams clouds = params.clouds;
  if (!params.lasers.lidar.present) return clouds;
  clouds.displacement_variance_share *= clouds.lidar_variance_factor;
  clouds.tilt_variance_share *= clouds.lidar_variance_factor;
  clouds.attitude_sd_rad *= std::sqrt(clouds.lidar_variance_factor);
  return clouds;
}

/// The elements up to and including that of `map`.
template <class T>
std::span<const T> up_to(int map, const std::vector<T>& all) {
  return std::span(all).first(static_cast<std::size_t>(map) + 1);
}

void sort_by_likelihood(std::vector<LoopClosure>& loop_closures) {
  std::stable_sort(
      loop_closures.begin(), loop_closures.end(), [](const LoopClosure& a, const LoopClosure& b) {
        return a.alternatives.front().log_likelihood > b.alternatives.front().log_likelihood;
      });
}

/// Without the lines that odometry has placed, of which a match of 3D scans must be independent.
Cloud from_one_place(const Cloud& cloud) {
  Cloud at_place = cloud;
  std::erase_if(at_place.lines, [&](const CloudLine& line) { return !is_at_place(cloud, line); });
  return at_place;
}

}  // namespace

Mapping::Mapping(const MappingParams& params)
    : params_(params),
      mounts_{{"LASER_FRONT", params.lasers.front}, {"LASER_REAR", params.lasers.rear}},
      builder_(builder_params(params), mounts_),
      association_(params.association),
      maps_(params.scratch),
      walls_(params.scratch),
      heights_(params.heights),
      clouds_(cloud_params(params)),
      contradictions_(params.matching, kContradiction) {}

std::optional<MapUpdate> Mapping::restore(StoredMap stored) {
  lost_ = stored.losses.local_maps;
  end_is_lost_ = stored.losses.end;
  for (LocalMap& map : stored.maps) append_map(std::move(map));
  if (!maps_.empty()) association_.restore(stored.associations);
  add_matches(stored.cloud_matches);
  update_heights();
  revision_ = static_cast<std::int64_t>(maps_.size());
  std::optional<MapUpdate> update;
  if (stored.unfinished) update = add_local_map(std::move(*stored.unfinished));
  if (maps_.empty()) return update;
  if (!update) {
    update_rivals();
    update_covariance_from_first();
    update_contradictions();
  }
  builder_ = LocalMapBuilder(builder_params(params_), mounts_, maps_.back().id + 1,
                             maps_.back().session + 1);
  if (!stored.cloud_matches.empty()) builder_.expect_ground();
  odom_ = Odom::kRestored;
  odom_continues_ = true;
  return update;
}

/// Detects whether the odom frame of the scan is that of the previous scan, or of the end of the
/// restored map.
void Mapping::update_odom(const ScanMatch& match) {
  if (match.status == ScanMatch::Status::kRejected) return;
  bool new_frame = match.status == ScanMatch::Status::kFirstScan && match.reference_utime == 0;
  if (odom_epoch_utime_) {
    new_frame |= *odom_epoch_utime_ != match.odom_epoch_utime;
  } else if (!maps_.empty()) {
    new_frame |= match.odom_epoch_utime > maps_.back().end_utime;
  }
  odom_epoch_utime_ = match.odom_epoch_utime;
  if (new_frame) odom_continues_ = false;
  if (new_frame && (!maps_.empty() || !builder_.current().scans.empty())) odom_ = Odom::kNew;
  if (!new_frame && odom_ == Odom::kRestored) odom_ = Odom::kKnown;
}

void Mapping::restart_time() {
  builder_.restart_time();
  rest_utime_ = builder_.current().end_utime;
}

std::optional<MapUpdate> Mapping::add(const std::string& channel, const LaserScan& scan,
                                      const ScanMatch& match) {
  update_odom(match);
  auto map = builder_.add(channel, scan, match);
  if (new_cloud_ && place_cloud()) rested_ = false;  // it may tell more of where the body rests
  if (map) return add_local_map(std::move(*map));
  const std::vector<LocalScan>& scans = builder_.current().scans;
  if (scans.empty()) return std::nullopt;
  if (builder_.current().end_utime != rest_utime_) {  // the body moves
    rest_utime_ = builder_.current().end_utime;
    rested_ = false;
    at_rest_.reset();
  } else if (!rested_ && seconds(scan.utime - rest_utime_) >= kRestS) {
    rested_ = true;
    localise_at_rest();
  }
  return std::nullopt;
}

void Mapping::add(const Cloud& cloud) {
  builder_.expect_ground();
  if (builder_.current().scans.empty() || odom_ == Odom::kRestored) return;
  new_cloud_ = from_one_place(cloud);
  builder_.begin_at_next_scan();
}

/// A cloud of the last odom frame has no place in the current local map: false.
bool Mapping::place_cloud() {
  const Cloud cloud = *std::exchange(new_cloud_, std::nullopt);
  const LocalMap& current = builder_.current();
  if (current.scans.empty() || !odom_epoch_utime_ || cloud.utime < *odom_epoch_utime_) return false;
  clouds_.add(cloud, current.session,
              {cloud.utime, current.id, cloud.z_odom_m - current.z_odom_m, builder_.forward_m()},
              between(current.T_odom_local, cloud.T_odom_level));
  return true;
}

/// The pose of a body that rests near home may depend on the wheels over two local maps, although
/// it sees the walls of the first one. What it saw last is therefore matched as a local map that
/// begins at the body, so that no displacement lies between, and is not stored. So are 3D scans
/// that were taken there.
void Mapping::localise_at_rest() {
  if (maps_.empty() || odom_ != Odom::kKnown || localization_ || !session_is_connected()) return;
  const Eigen::Matrix3d before_covariance = body_covariance();
  LocalMap here = map_at_body();
  const Pose2 T_map_here = association_.hypothesis().T_map_local.back() * here.T_previous_local;
  if (between(association_.hypothesis().T_map_local.front(), T_map_here).translation().norm() >
          kNearHomeM ||
      position_sd_m(before_covariance) < kSureSdM)
    return;
  LazyAssociation::Checkpoint before = association_.checkpoint();
  const Pose2 T_odom_here = here.T_odom_local;
  const Pose2 T_current_here = between(builder_.current().T_odom_local, T_odom_here);
  const int id = here.id;
  const WheelScaleError last_error = scale_error_since_newest();
  append_map(std::move(here));
  heights_.add_new(maps_.headers());
  const auto decide = [&](std::vector<LoopClosure> loop_closures) {
    return std::ranges::any_of(association_.decide(std::move(loop_closures), maps_.back().utime),
                               [](const Association& a) { return a.chosen != Association::kNone; });
  };
  bool found = decide(loop_closures(id, association_.trial(), false));
  found |= decide(matches_of_clouds_at(T_current_here));
  const std::vector<SessionRival> before_rivals = rivals_;
  update_rivals();
  std::vector<WheelScaleError> errors = scale_errors_from_first(id, id);
  if (const auto response = association_.trial().displacement_response(id, id)) {
    errors.push_back(moved(*response, last_error));
  }
  const Eigen::Matrix3d covariance = association_.trial().covariance(0, id) + moment_of_rivals(id) +
                                     common_scale_covariance(std::move(errors));
  rivals_ = before_rivals;
  if (found && position_sd_m(covariance) < position_sd_m(before_covariance)) {
    at_rest_ = {association_.hypothesis().T_map_local.back() * T_odom_here.inverse(), covariance};
  }
  association_.roll_back(std::move(before));
  remove_newest_map();
  update_heights();
}

/// The loop closures of the newest local map by the 3D scans of the unfinished one, in which the
/// newest begins at this pose.
std::vector<LoopClosure> Mapping::matches_of_clouds_at(const Pose2& T_current_here) {
  const int id = maps_.back().id;
  std::vector<LoopClosure> loop_closures;
  for (MatchedClouds& matched : matches_of_clouds(id, T_current_here.inverse())) {
    for (LoopClosureAlternative& alternative : matched.loop_closure.alternatives) {
      const UncertainPose T_older_here =
          UncertainPose{alternative.T_older_newer, alternative.information.inverse()} *
          UncertainPose{T_current_here, Eigen::Matrix3d::Zero()};
      alternative.T_older_newer = T_older_here.T_from_to;
      alternative.information = T_older_here.covariance.inverse();
    }
    loop_closures.push_back(std::move(matched.loop_closure));
  }
  return loop_closures;
}

/// The 3D scans of a local map, which lies at `T_newest_map` in the newest one of the graph,
/// matched with those of the same session.
std::vector<MatchedClouds> Mapping::matches_of_clouds(int map, const Pose2& T_newest_map) {
  const std::vector<Pose2>& poses = association_.hypothesis().T_map_local;
  return clouds_.matches(
      map,
      [&](int i) {
        const Pose2& T_map_local = poses[static_cast<std::size_t>(i)];
        return PlacedLocalMap{i == map ? T_map_local * T_newest_map : T_map_local,
                              heights_.height_m(i)};
      },
      [&](int older) { return association_.trial().covariance(older, map); });
}

/// The last part of the unfinished local map, as a local map that begins at the body.
LocalMap Mapping::map_at_body() const {
  LocalMap here = builder_.current();
  const LocalScan last = here.scans.back();
  std::erase_if(here.scans, [&](const LocalScan& scan) {
    return between(last.T_local_body, scan.T_local_body).translation().norm() > kSeenAtRestM;
  });
  for (LocalScan& scan : here.scans) {
    scan.T_local_body = between(last.T_local_body, scan.T_local_body);
    scan.z_m -= last.z_m;
  }
  const UncertainPose T_previous_here =
      UncertainPose{here.T_previous_local, here.information.inverse()} *
      UncertainPose{last.T_local_body, builder_.covariance_local_body()};
  here.utime = here.scans.front().scan.utime;
  here.T_odom_local = here.T_odom_local * last.T_local_body;
  here.T_previous_local = T_previous_here.T_from_to;
  here.information = T_previous_here.covariance.inverse();
  here.climb_m += last.z_m;
  here.z_odom_m += last.z_m;
  return here;
}

std::optional<MapUpdate> Mapping::finish() {
  auto map = builder_.finish();
  if (!map) return std::nullopt;
  return add_local_map(std::move(*map));
}

MapUpdate Mapping::add_local_map(LocalMap map) {
  at_rest_.reset();
  const bool begins = begins_session(map, maps_);
  if (begins) link_session(map);
  if (begins && map.session == builder_.current().session) odom_ = Odom::kKnown;
  std::optional<LazyAssociation::Checkpoint> before;
  if (params_.maps_per_place_max > 0 && !begins) before = association_.checkpoint();
  localization_.reset();
  MapUpdate update;
  update.map = map;
  append_map(std::move(map));  // section 2.1
  for (const CloudPlace& place : clouds_.places(update.map.id)) heights_.add(place);
  heights_.add_new(maps_.headers());  // to tell levels apart
  associate(update);                  // sections 2.2 and 2.3
  if (!update.associations.empty()) update_heights();
  ++revision_;
  update_rivals();
  covariance_ = covariance_in_older_sessions();
  if (before && is_redundant(update)) {
    discard_newest(update, std::move(*before));
  } else {
    update_covariance_from_first();
  }
  update_contradictions();
  return update;
}

/// Decides the loop closures of the newest map, then revises earlier decisions if the newest maps
/// are unlikely.
void Mapping::associate(MapUpdate& update) {
  const LocalMap& newest = update.map;
  update.associations =
      association_.decide(loop_closures(newest.id, association_.trial(), false), newest.end_utime);
  associate_clouds(update);
  const std::vector<Association> revised = association_.revise(*this, newest.end_utime);
  update.associations.insert(update.associations.end(), revised.begin(), revised.end());
}

/// Matches the 3D scans of the newest local map with those of the same session, and decides the
/// loop closures.
void Mapping::associate_clouds(MapUpdate& update) {
  const std::vector<MatchedClouds> matches = matches_of_clouds(update.map.id, {});
  if (matches.empty()) return;
  std::vector<LoopClosure> loop_closures;
  for (const MatchedClouds& matched : matches) loop_closures.push_back(matched.loop_closure);
  const std::vector<Association> decided =
      association_.decide(std::move(loop_closures), update.map.end_utime);
  update.associations.insert(update.associations.end(), decided.begin(), decided.end());
  // Without an IMU the attitude is that of the ground, whose error is not constant.
  const LocalScan& last = maps_.back().scans.back();
  if (!last.attitude || last.attitude_from_ground) return;
  for (const MatchedClouds& matched : matches) update.cloud_matches.push_back(matched.match);
  add_matches(update.cloud_matches);
}

/// Adds what matches of 3D scans tell of heights and, of those whose loop closures are accepted, of
/// the constant error of the attitude. In the order of their newer local maps, which have none yet.
void Mapping::add_matches(std::span<const CloudMatch> matches) {
  for (const CloudMatch& match : matches) heights_.add(match);
  const auto in_force = constraints_in_force(association_.problem(), association_.hypothesis());
  for (const PoseConstraint& loop_closure : in_force) {
    if (matches.empty() || loop_closure.to < matches.front().newer.map) continue;
    const CloudMatch* const match = heights_.match_of(loop_closure);
    if (match == nullptr) continue;
    const int session = maps_[static_cast<std::size_t>(loop_closure.to)].session;
    LevelError& error =
        level_errors_.try_emplace(session, params_.heights.pitch_sd_rad).first->second;
    error.add(match->turn_rad, match->tilt_rad, match->tilt_covariance);
    heights_.set_tilt_prior(session, error.as_prior());
  }
}

/// Whether the newest local map may be discarded: it is matched to as many older maps as are stored
/// per place, the most likely of all proposals among them, and no decision was revised for it. A
/// rejected loop closure beside so many accepted ones shows nothing new. The current local map must
/// follow it in the same odom frame.
bool Mapping::is_redundant(const MapUpdate& update) const {
  const LocalMap& next = builder_.current();
  if (next.session != update.map.session || next.id != update.map.id + 1) return false;
  std::vector<Association> decided = update.associations;
  std::erase_if(decided, [&](const Association& a) {  // of 3D scans
    return is_neighbour(a.loop_closure.alternatives.front().older_map, a.loop_closure.newer_map);
  });
  const bool found_first = !decided.empty() && decided.front().chosen != Association::kNone;
  const auto found = std::ranges::count_if(
      decided, [](const Association& a) { return a.chosen != Association::kNone; });
  const bool all_proposed = std::ranges::all_of(
      decided, [](const Association& a) { return a.action == Association::Action::kProposed; });
  if (!found_first || !all_proposed || found < params_.maps_per_place_max) return false;
  const std::vector<Pose2>& poses = association_.hypothesis().T_map_local;
  std::vector<MapExtent::Placed> older;
  for (const NearMap& near : within_reach(poses, kBesideM, Eigen::Matrix3d::Zero())) {
    const auto k = static_cast<std::size_t>(near.older);
    older.push_back({&extents_[k], between(poses.back(), poses[k])});
  }
  return extents_.back().covered_by(older) >= kRedundantShare;
}

/// Discards the newest local map, and links the next one to the last stored map by the estimated
/// pose of the body. The link includes information of the graph that the loop closures of the next
/// map will contain again; as the relative poses of the maps that they link to are far more
/// certain, this makes no estimate overconfident.
void Mapping::discard_newest(MapUpdate& update, LazyAssociation::Checkpoint before) {
  const std::vector<Pose2>& poses = association_.hypothesis().T_map_local;
  const Association& best = update.associations.front();
  const auto chosen = static_cast<std::size_t>(best.chosen);
  localization_ = {update.map.end_utime, best.loop_closure.alternatives[chosen].older_map,
                   poses.back() * update.map.T_odom_local.inverse(),
                   heights_.height_m(update.map.id) - update.map.z_odom_m};
  const UncertainPose T_last_here{
      between(poses[poses.size() - 2], poses.back()),
      association_.trial().covariance(update.map.id - 1, update.map.id)};
  association_.roll_back(std::move(before));
  remove_newest_map();
  builder_.replace_last_map(T_last_here, update.map);
  clouds_.discard(update.map.id);
  update_heights();
  --revision_;
  update.stored = false;
}

/// The covariance relative to the older local map for which it is smallest.
std::optional<Eigen::Matrix3d> Mapping::covariance_in_older_sessions() {
  const int session = maps_.back().session;
  if (maps_.front().session == session) return std::nullopt;
  const auto first = std::ranges::lower_bound(maps_.headers(), session, {}, &LocalMap::session);
  const int newest = static_cast<int>(maps_.size()) - 1;
  return association_.trial().least_covariance(newest,
                                               static_cast<int>(first - maps_.headers().begin())) +
         moment_of_rivals(newest);
}

void Mapping::update_covariance_from_first() {
  if (maps_.size() < 2) return;
  const int newest = static_cast<int>(maps_.size()) - 1;
  covariance_from_first_ = association_.trial().covariance(0, newest) + moment_of_rivals(newest);
  scale_errors_from_first_ = scale_errors_from_first(newest, newest + 1);
}

/// How the scale of the wheels affects the pose of a local map in the first one, by the
/// displacements of this session that end before `end`.
std::vector<WheelScaleError> Mapping::scale_errors_from_first(int map, int end) {
  std::vector<WheelScaleError> errors;
  for (const auto& [to, error] : builder_.wheel_scale_errors()) {
    if (to >= end) break;
    const auto response = association_.trial().displacement_response(map, to);
    if (response) errors.push_back(moved(*response, error));
  }
  return errors;
}

/// Of the body relative to the newest local map, in the body frame.
WheelScaleError Mapping::scale_error_since_newest() const {
  const LocalMap& current = builder_.current();
  const auto& errors = builder_.wheel_scale_errors();
  const auto of_current = errors.find(current.id);
  return composed(of_current != errors.end() ? of_current->second : WheelScaleError{},
                  builder_.wheel_scale_error_body(),
                  adjoint(current.scans.back().T_local_body.inverse()));
}

void Mapping::update_rivals() {
  std::vector<int> first_maps;
  for (const LocalMap& map : maps_.headers()) {
    if (first_maps.empty() || maps_.headers()[as_index(first_maps.back())].session != map.session)
      first_maps.push_back(map.id);
  }
  rivals_ = session_rivals(association_.problem(), association_.hypothesis(), first_maps);
}

/// What places where sessions may lie instead add to the covariance of a local map relative to
/// those of older sessions.
Eigen::Matrix3d Mapping::moment_of_rivals(int map) const {
  Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();
  for (const SessionRival& rival : rivals_)
    moment += moment_of(rival, association_.hypothesis(), map);
  return moment;
}

/// With gates so wide that a local map is also found where its session may lie instead.
void Mapping::widen_to_rivals(int map, std::vector<NearMap>& near) const {
  for (const SessionRival& rival : rivals_) {
    if (map < rival.first || map >= rival.end) continue;
    const Eigen::Matrix3d spread =
        spread_to(rival, association_.hypothesis(), map, params_.candidates.sigmas);
    for (NearMap& older : near) {
      if (older.older < rival.first) older.covariance += spread;
    }
  }
}

/// From the first local map to the newest, from there to the current one, and in that to the body.
Eigen::Matrix3d Mapping::body_covariance() const {
  const LocalMap& current = builder_.current();
  UncertainPose T_first_body{{}, covariance_from_first_};
  if (current.session != maps_.back().session || current.scans.empty())
    return T_first_body.covariance;
  const Pose2& T_current_body = current.scans.back().T_local_body;
  T_first_body = T_first_body *
                 UncertainPose{current.T_previous_local, current.information.inverse()} *
                 UncertainPose{T_current_body, builder_.covariance_local_body()};
  const Eigen::Matrix3d to_body = adjoint((current.T_previous_local * T_current_body).inverse());
  std::vector<WheelScaleError> errors = scale_errors_from_first_;
  for (WheelScaleError& error : errors) error = moved(to_body, error);
  errors.push_back(scale_error_since_newest());
  return T_first_body.covariance + common_scale_covariance(std::move(errors));
}

void Mapping::append_map(LocalMap map) {
  walls_.push_back(local_walls(map, mounts_, params_.walls));
  extents_.emplace_back(*walls_.back());
  reach_m_.push_back(extents_.back().reach_m());
  association_.add_map(map.T_previous_local, map.information);
  maps_.push_back(std::move(map));
}

void Mapping::remove_newest_map() {
  maps_.pop_back();
  walls_.pop_back();
  extents_.pop_back();
  reach_m_.pop_back();
}

/// The maps before the last of these that have walls within its reach, or nearly so; with this
/// covariance.
std::vector<NearMap> Mapping::within_reach(std::span<const Pose2> T_map_local, double tolerance_m,
                                           const Eigen::Matrix3d& covariance) const {
  const std::size_t newest = T_map_local.size() - 1;
  const double margin_m = reach_m_[newest] + tolerance_m;
  std::vector<NearMap> near;
  for (std::size_t i = 0; i < newest; ++i) {
    const Eigen::Vector2d apart = T_map_local[i].translation() - T_map_local[newest].translation();
    const double within_m = reach_m_[i] + margin_m;
    if (apart.squaredNorm() <= within_m * within_m)
      near.push_back({static_cast<int>(i), covariance});
  }
  return near;
}

void Mapping::update_heights() {
  std::vector<PoseConstraint> loop_closures =
      constraints_in_force(association_.problem(), association_.hypothesis());
  // Between neighbours there are those of 3D scans only, and the ground is that of the chain.
  std::erase_if(loop_closures, [&](const PoseConstraint& loop_closure) {
    return is_neighbour(loop_closure.from, loop_closure.to) && !heights_.is_match(loop_closure);
  });
  heights_.update(maps_.headers(), walls_, loop_closures);
}

void Mapping::update_contradictions() {
  const auto same_level = [this](int older, int newer, const Pose2& T_older_newer) {
    return heights_.same_level(older, newer, T_older_newer, walls_);
  };
  const std::vector<Pose2>& poses = association_.hypothesis().T_map_local;
  const auto around = [&](int map) { return walls_around(map, poses); };
  contradictions_.update(walls_, extents_, poses, around, same_level);
}

/// Links a session to the end of the previous one, loosely: if odom continues, a few metres of the
/// path are missing at most; if it was reset, the body is where it was, or was carried anywhere.
void Mapping::link_session(LocalMap& map) const {
  const LocalMap& last = maps_.back();
  const Pose2 T_last_end = last.scans.empty() ? Pose2{} : last.scans.back().T_local_body;
  map.T_previous_local = T_last_end;
  map.information = information_of_unknown_pose();
  if (odom_continues_) {
    map.T_previous_local = between(last.T_odom_local, map.T_odom_local);
    const double unseen_m = between(T_last_end, map.T_previous_local).translation().norm();
    map.information = information_across_gap(unseen_m);
  } else if (!params_.carried) {
    const Eigen::Vector3d sd(params_.restart_sd_m, params_.restart_sd_m, params_.restart_sd_rad);
    map.information = sd.cwiseInverse().cwiseAbs2().asDiagonal();
  }
}

std::vector<Association> Mapping::reconnect() {
  std::vector<Association> decided;
  for (const int lost : lost_) {
    const int after = lost + 1;
    const bool ends_gap = std::ranges::find(lost_, after) == lost_.end();
    if (lost == 0 || !ends_gap || is_bridged(after)) continue;
    for (int map = after; map < after + kMapsAfterGap && map < static_cast<int>(maps_.size());
         ++map) {
      if (maps_[static_cast<std::size_t>(map)].scans.empty()) break;
      const auto found =
          association_.decide(loop_closures_over_gap(map, after), maps_.back().end_utime);
      decided.insert(decided.end(), found.begin(), found.end());
    }
  }
  if (decided.empty()) return decided;
  ++revision_;
  update_heights();
  update_rivals();
  covariance_ = covariance_in_older_sessions();
  update_covariance_from_first();
  update_contradictions();
  return decided;
}

/// Whether a loop closure in force leads over the gap before this local map.
bool Mapping::is_bridged(int first_after_gap) const {
  const auto in_force = constraints_in_force(association_.problem(), association_.hypothesis());
  return std::ranges::any_of(in_force, [&](const PoseConstraint& c) {
    return c.from < first_after_gap && c.to >= first_after_gap;
  });
}

/// With local maps before the gap only; those next to it are no neighbours in the chain.
std::vector<LoopClosure> Mapping::loop_closures_over_gap(int map, int first_after_gap) {
  Trial& trial = association_.trial();
  std::vector<Pose2> poses = trial.poses();
  poses.resize(static_cast<std::size_t>(map) + 1);
  LoopClosureCandidatesParams params = params_.candidates;
  params.neighbours = map - first_after_gap;
  return matches_of(loop_closure_candidates(poses, trial.near_maps(map, reach_m_, params.sigmas),
                                            up_to(map, extents_), params),
                    map, poses);
}

bool Mapping::session_is_connected() const {
  const int session = maps_.back().session;
  if (maps_.front().session == session) return true;
  const auto session_of = [&](int map) { return maps_[static_cast<std::size_t>(map)].session; };
  const std::vector<LoopClosure>& loop_closures = association_.problem().loop_closures;
  const std::vector<int>& chosen = association_.hypothesis().chosen;
  for (std::size_t k = chosen.size(); k-- > 0;) {  // in order of the newer map
    if (session_of(loop_closures[k].newer_map) != session) break;
    if (chosen[k] == Association::kNone) continue;
    if (session_of(constraint_of(loop_closures[k], chosen[k]).from) != session) return true;
  }
  return false;
}

/// Searches the newest map in all maps of the older sessions.
std::vector<LoopClosure> Mapping::relocalise() const {
  std::vector<LoopClosure> loop_closures;
  const std::vector<Pose2>& poses = association_.hypothesis().T_map_local;
  const int session = maps_.back().session;
  for (int older = 0; maps_[static_cast<std::size_t>(older)].session != session; ++older) {
    LoopClosure loop_closure;
    loop_closure.newer_map = static_cast<int>(maps_.size()) - 1;
    loop_closure.alternatives = found_anywhere(*walls_.back(), older, poses);
    if (!loop_closure.alternatives.empty()) loop_closures.push_back(std::move(loop_closure));
  }
  sort_by_likelihood(loop_closures);
  if (loop_closures.size() > kRelocalisations) loop_closures.resize(kRelocalisations);
  return loop_closures;
}

/// Searches the walls of a local map in an older one, at any pose where they have walls in common.
std::vector<LoopClosureAlternative> Mapping::found_anywhere(const LocalWalls& newer, int older,
                                                            const std::vector<Pose2>& poses) const {
  RelativePose anywhere;
  anywhere.T_older_newer = {extents_[static_cast<std::size_t>(older)].centre().x(),
                            extents_[static_cast<std::size_t>(older)].centre().y(), 0.0};
  anywhere.covariance =
      Eigen::Vector3d(kSearchM, kSearchM, std::numbers::pi).cwiseAbs2().asDiagonal();
  std::vector<LoopClosureAlternative> found =
      match_maps(newer, walls_around(older, poses), older, anywhere, params_.matching);
  std::erase_if(found, [](const LoopClosureAlternative& a) {
    return a.log_likelihood < kRelocalisedLogLikelihood;
  });
  return found;
}

/// Whether the maps are neighbours in the chain of one session, which constrains them as a match
/// would.
bool Mapping::is_neighbour(int older, int newer) const {
  return newer - older <= params_.candidates.neighbours &&
         maps_[static_cast<std::size_t>(older)].session ==
             maps_[static_cast<std::size_t>(newer)].session;
}

std::vector<LoopClosure> Mapping::loop_closures(int map, Trial& trial, bool thorough) const {
  if (map < 1) return {};
  const bool newest = map + 1 == static_cast<int>(maps_.size());
  const bool joined = !newest || session_is_connected();
  if (!joined && !odom_continues_ && params_.carried) return relocalise();
  std::vector<Pose2> poses = trial.poses();
  poses.resize(static_cast<std::size_t>(map) + 1);
  LoopClosureCandidatesParams params = params_.candidates;
  // The link to the previous session is too loose for neighbours in the chain to be excluded.
  const bool loosely_linked = !joined && !params_.carried;
  if (loosely_linked) {
    params.neighbours = 0;
    params.most += params_.candidates.neighbours;
  }
  const auto candidates_of = thorough ? thorough_candidates : loop_closure_candidates;
  const double sigmas = (thorough ? kThoroughSds : 1.0) * params.sigmas;
  std::vector<NearMap> near = trial.near_maps(map, reach_m_, sigmas);
  widen_to_rivals(map, near);
  std::vector<LoopClosureCandidate> candidates =
      candidates_of(poses, near, up_to(map, extents_), params);
  std::erase_if(candidates, [&](const LoopClosureCandidate& candidate) {
    return loosely_linked && is_neighbour(candidate.older, map);
  });
  return matches_of(candidates, map, poses);
}

/// The loop closures of a local map with these candidates, the most likely first.
std::vector<LoopClosure> Mapping::matches_of(const std::vector<LoopClosureCandidate>& candidates,
                                             int map, const std::vector<Pose2>& poses) const {
  std::vector<LoopClosure> found;
  for (const LoopClosureCandidate& candidate : candidates) {
    LoopClosure loop_closure;
    loop_closure.newer_map = map;
    loop_closure.alternatives =
        match_maps(*walls_[static_cast<std::size_t>(map)], walls_around(candidate.older, poses),
                   candidate.older, candidate.predicted, params_.matching);
    std::erase_if(loop_closure.alternatives, [&](const LoopClosureAlternative& alternative) {
      return !heights_.same_level(candidate.older, map, alternative.T_older_newer, walls_);
    });
    if (!loop_closure.alternatives.empty()) found.push_back(std::move(loop_closure));
  }
  sort_by_likelihood(found);
  add_deformations(found);
  return found;
}

/// Covariance of the place of a local map's walls, in its frame: (x, y, θ), without the lever arm
/// of the heading. What was seen from its end has the error of the displacement to the next one,
/// what was seen at its beginning none; of the mean the variance is less than half.
Eigen::Matrix3d Mapping::deformation(int map) const {
  const std::size_t next = static_cast<std::size_t>(map) + 1;
  const LocalMap& end = next < maps_.size() ? maps_[next] : builder_.current();
  if (end.id != map + 1 || end.session != maps_[next - 1].session) return Eigen::Matrix3d::Zero();
  const Eigen::Matrix3d R = rotation_of(end.T_previous_local.theta);
  return kDeformationShare * R * end.information.inverse() * R.transpose();
}

/// A match places rigid walls, but both maps are bent by the errors of their displacements.
void Mapping::add_deformations(std::vector<LoopClosure>& loop_closures) const {
  for (LoopClosure& loop_closure : loop_closures) {
    const Eigen::Matrix3d newer = deformation(loop_closure.newer_map);
    for (LoopClosureAlternative& alternative : loop_closure.alternatives) {
      const Eigen::Matrix3d R = rotation_of(-alternative.T_older_newer.theta);
      const Eigen::Matrix3d older = R * deformation(alternative.older_map) * R.transpose();
      alternative.information = with_added_covariance(alternative.information, newer + older);
    }
  }
}

/// The contradictions between the newest maps and the older ones that they overlap, and those found
/// earlier between others, at these poses.
double Mapping::map_inconsistency(const std::vector<Pose2>& T_map_local) const {
  const int newest = static_cast<int>(maps_.size()) - 1;
  double map_inconsistency = 0.0;
  const Eigen::Matrix3d covariance = kInconsistencySd.cwiseAbs2().asDiagonal();
  const double tolerance_m = params_.candidates.sigmas * kInconsistencySd.head<2>().norm();
  for (int map = std::max(0, newest - kMapsMonitored + 1); map <= newest; ++map) {
    const auto poses = up_to(map, T_map_local);
    double largest = 0.0;
    const std::vector<NearMap> near = within_reach(poses, tolerance_m, covariance);
    for (const LoopClosureCandidate& candidate :
         loop_closure_candidates(poses, near, up_to(map, extents_), params_.candidates)) {
      const Pose2& T_older_newer = candidate.predicted.T_older_newer;
      if (!heights_.same_level(candidate.older, map, T_older_newer, walls_)) continue;
      largest = std::max(largest, contradiction(*walls_[static_cast<std::size_t>(map)],
                                                walls_around(candidate.older, poses), T_older_newer,
                                                params_.matching, largest));
    }
    map_inconsistency += largest;
  }
  for (const auto& [older, newer] : known_contradictions(newest - kMapsMonitored)) {
    const auto poses = up_to(newer, T_map_local);
    const Pose2 T_older_newer = between(poses[static_cast<std::size_t>(older)], poses.back());
    map_inconsistency += contradiction(*walls_[static_cast<std::size_t>(newer)],
                                       walls_around(older, poses), T_older_newer, params_.matching);
  }
  return map_inconsistency;
}

/// Of each map up to `last` the pair (older, newer) with the most evidence, the strongest ones.
std::vector<std::array<int, 2>> Mapping::known_contradictions(int last) const {
  std::map<int, MapContradiction> by_newer;
  for (const MapContradiction& pair : contradictions_.contradictions()) {
    MapContradiction& strongest = by_newer[pair.newer_map];
    if (pair.newer_map <= last && pair.evidence > strongest.evidence) strongest = pair;
  }
  std::vector<MapContradiction> found;
  for (const auto& [newer, pair] : by_newer) {
    if (pair.evidence > 0.0) found.push_back(pair);
  }
  std::ranges::stable_sort(found, std::greater{}, &MapContradiction::evidence);
  if (found.size() > kContradictionsMonitored) found.resize(kContradictionsMonitored);
  std::vector<std::array<int, 2>> pairs;
  for (const MapContradiction& pair : found) pairs.push_back({pair.older_map, pair.newer_map});
  return pairs;
}

/// The walls of a map and of its neighbours in the chain, in its frame.
std::vector<PlacedWalls> Mapping::walls_around(int map, std::span<const Pose2> T_map_local) const {
  const auto at = [](int i) { return static_cast<std::size_t>(i); };
  std::vector<PlacedWalls> placed;
  for (const int k : {map, map - 1, map + 1}) {
    if (k < 0 || k >= static_cast<int>(T_map_local.size())) continue;
    if (maps_[at(k)].session != maps_[at(map)].session) continue;
    const double z_m = k < map ? -maps_[at(map)].climb_m : k > map ? maps_[at(k)].climb_m : 0.0;
    placed.push_back({walls_[at(k)], between(T_map_local[at(map)], T_map_local[at(k)]), z_m,
                      association_.problem().odometry.between(map, k).covariance});
  }
  return placed;
}

MapGraph Mapping::graph() const {
  MapGraph graph;
  graph.utime = maps_.empty() ? 0 : maps_.back().end_utime;
  graph.revision = revision_;
  graph.poses = association_.hypothesis().T_map_local;
  const Eigen::VectorXd z_variance = heights_.variances_to(0);
  for (int i = 0; i < static_cast<int>(graph.poses.size()); ++i) {
    graph.z_m.push_back(heights_.height_m(i));
    graph.z_variance.push_back(z_variance[i]);
  }
  for (const PoseConstraint& c : association_.problem().chain) {
    graph.constraints.push_back({c, MapConstraint::Kind::kSequential});
  }
  for (const auto& c : constraints_in_force(association_.problem(), association_.hypothesis())) {
    graph.constraints.push_back({c, MapConstraint::Kind::kLoopClosure});
  }
  return graph;
}

MapContradictions Mapping::contradictions() const {
  return {maps_.empty() ? 0 : maps_.back().end_utime, revision_, contradictions_.contradictions()};
}

std::optional<MapCorrection> Mapping::correction() const {
  if (maps_.empty() || odom_ != Odom::kKnown) return std::nullopt;
  const LocalMap& newest = maps_.back();
  MapCorrection correction;
  correction.utime = newest.end_utime;
  correction.revision = revision_;
  correction.session = newest.session;
  correction.local_map = newest.id;
  correction.T_map_odom =
      association_.hypothesis().T_map_local.back() * newest.T_odom_local.inverse();
  correction.z_map_odom_m = heights_.height_m(newest.id) - newest.z_odom_m;
  correction.z_variance = heights_.variance(0, newest.id);
  correction.covariance = covariance_;
  correction.body_covariance = body_covariance();
  if (at_rest_) {
    correction.utime = builder_.current().end_utime;
    correction.T_map_odom = at_rest_->T_map_odom;
    correction.body_covariance = at_rest_->body_covariance;
  }
  if (end_is_lost_) correction.body_covariance = information_of_unknown_pose().inverse();
  if (localization_) {
    correction.utime = localization_->utime;
    correction.local_map = localization_->older_map;
    correction.T_map_odom = localization_->T_map_odom;
    correction.z_map_odom_m = localization_->z_map_odom_m;
  }
  return correction;
}

}  // namespace adit
