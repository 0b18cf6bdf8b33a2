// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/volume.hpp"

#include <string_view>
#include <utility>

#include "common/messages/pieces.hpp"
#include "common/messages/planar.hpp"

namespace adit {
namespace {

std::string_view reason_to_refuse_volume(const volume_t& message) {
  if (!is_plausible_utime(message.utime)) return kImplausibleTime;
  if (message.id < 0 || message.local_map < 0) return "negative id";
  if (message.revision < 1) return "sub-volume of no cloud";
  if (message.graph_revision < 0) return "negative revision";
  if (!all_finite(message.T_map_volume)) return kPoseNotFinite;
  if (!(message.cell_m > 0.0 && message.cell_m <= VolumePiece::kCellMaxM)) {
    return "cells of no plausible size";
  }
  if (message.occupied < 0 || message.free < 0) return "negative number of cells";
  return {};
}

std::string_view reason_to_refuse_place(const volume_t& message) {
  if (message.n_pieces < 0) return "negative number of pieces";
  if (message.n_pieces > VolumePiece::kPiecesMax) return "more pieces than plausible";
  if (message.n_pieces == 0) {
    return message.piece == 0 && message.n_bytes == 0 ? "" : "octree in a message of a pose only";
  }
  if (message.piece < 0 || message.piece >= message.n_pieces) return "piece of a higher number";
  if (message.getEncodedSize() > kPieceBytesMax) return "larger than a piece may be";
  return {};
}

}  // namespace

volume_t to_message(const VolumePiece& piece) {
  const Volume& volume = piece.part;
  volume_t message;
  message.utime = volume.utime;
  message.id = volume.id;
  message.revision = volume.revision;
  message.graph_revision = volume.graph_revision;
  message.local_map = volume.local_map;
  set_pose(volume.T_map_volume, message.T_map_volume);
  message.cell_m = volume.cell_m;
  message.occupied = volume.occupied;
  message.free = volume.free;
  message.n_pieces = piece.n_pieces;
  message.piece = piece.piece;
  message.n_bytes = static_cast<std::int32_t>(volume.octree.size());
  message.octree = volume.octree;
  return message;
}

Result<VolumePiece> from_message(const volume_t& message) {
  if (const auto reason = reason_to_refuse_volume(message); !reason.empty()) return Refused{reason};
  if (const auto reason = reason_to_refuse_place(message); !reason.empty()) return Refused{reason};
  Volume volume{message.utime,          message.id,        message.revision,
                message.graph_revision, message.local_map, pose_from(message.T_map_volume),
                message.cell_m,         message.occupied,  message.free,
                message.octree};
  return VolumePiece{std::move(volume), message.n_pieces, message.piece};
}

}  // namespace adit
