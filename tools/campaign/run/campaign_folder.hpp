// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace adit {

/// The files of a campaign. A unit runs in a folder of its own, which gets the name of the unit
/// when the unit has ended and its result is complete.
struct CampaignFolder {
  std::filesystem::path path;  ///< absolute

  [[nodiscard]] std::filesystem::path plan() const { return path / "plan.jsonl"; }
  [[nodiscard]] std::filesystem::path database() const { return path / "campaign.db"; }
  [[nodiscard]] std::filesystem::path page() const { return path / "campaign.html"; }
  /// Locked while `adit campaign` runs.
  [[nodiscard]] std::filesystem::path lock() const { return path / "campaign.lock"; }
  [[nodiscard]] std::filesystem::path slurm() const { return path / "slurm"; }
  [[nodiscard]] std::filesystem::path units() const { return path / "units"; }
  [[nodiscard]] std::filesystem::path unit(const std::string& id) const { return units() / id; }
  /// How the unit ended, see UnitResult.
  [[nodiscard]] std::filesystem::path result(const std::string& id) const {
    return unit(id) / "result.json";
  }
  /// What {out} stands for.
  [[nodiscard]] std::filesystem::path output(const std::string& id) const {
    return unit(id) / "out";
  }
  /// What the unit printed.
  [[nodiscard]] std::filesystem::path output_log(const std::string& id) const {
    return unit(id) / "output.log";
  }

  /// Removes attempts (.ID.HOST.PID, see UnitProcess) at units that have a result, and those of
  /// processes of this computer that were killed. Others on other nodes may still run.
  void remove_old_attempts() const;
};

/// Creates the folder of a campaign; removes it if it was created here and is not kept.
class NewCampaignFolder {
 public:
  explicit NewCampaignFolder(const CampaignFolder& folder);
  ~NewCampaignFolder();
  NewCampaignFolder(const NewCampaignFolder&) = delete;
  NewCampaignFolder& operator=(const NewCampaignFolder&) = delete;

  void keep() { created_ = false; }

 private:
  std::filesystem::path path_;
  bool created_;
};

}  // namespace adit
