// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/log_place.hpp"

#include <system_error>

#include "common/bus/log_parser.hpp"
#include "common/bus/log_writer.hpp"
#include "common/files/mapped_file.hpp"

namespace adit {

namespace fs = std::filesystem;

void place_log(const std::vector<fs::path>& logs, const fs::path& folder,
               const fs::path& unfinished) {
  const fs::path place = unfinished / "run.lcmlog";
  std::error_code error;
  // The folder of the mission itself, which has its logs and would hold them twice.
  if (fs::equivalent(logs.front(), folder / "run.lcmlog", error)) return;
  if (logs.size() == 1) {
    fs::create_hard_link(fs::canonical(logs.front()), place, error);
    if (error) fs::copy_file(logs.front(), place);
    return;
  }
  LogWriter writer(place);
  for (const fs::path& log : logs) {
    const MappedFile file(log);
    LogParser parser(file.bytes());
    while (const auto event = parser.next()) writer.write(*event);
  }
  writer.close();
}

}  // namespace adit
