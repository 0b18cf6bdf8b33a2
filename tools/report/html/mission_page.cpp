// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/html/mission_page.hpp"

#include "tools/report/html/html_elements.hpp"
#include "tools/report/html/page_sections.hpp"
#include "tools/report/html/page_template.hpp"
#include "tools/report/html/scan_cards.hpp"
#include "tools/report/html/text_format.hpp"

namespace adit {

std::string mission_page(const MissionRecords& records, const MissionStatistics& statistics,
                         const MapContent& map, const std::string& title,
                         const std::vector<std::string>& warnings) {
  std::string notes;
  for (const std::string& warning : warnings) {
    notes += element("p", escaped(sentence(warning)), "class=\"note\"");
  }
  const std::string& reason = statistics.return_home_reason;
  return fill_template(
      page_file("page"),
      {{"title", escaped(title)},
       {"simulated",
        statistics.simulated ? element("span", "simulated", "class=\"tag\"") : std::string()},
       {"map_style", page_file("map")},
       {"page_style", page_file("style")},
       {"script", page_file("script")},
       {"outcome", escaped(outcome_text(statistics))},
       {"start_time", date_text(statistics.from_utime)},
       {"return_home_reason",
        reason.empty() ? "" : "Reason for the return: " + escaped(sentence(reason))},
       {"warnings", notes},
       {"metrics", metrics_html(statistics, records)},
       {"map", map_svg(map)},
       {"timeline", timeline_html(records, statistics)},
       {"frontiers", frontiers_html(records)},
       {"scans", scan_cards(records, *map.map)},
       {"loop_closures", loop_closures_html(*map.map)},
       {"events", events_html(records)},
       {"configuration", configuration_html(records.log_info)}});
}

}  // namespace adit
