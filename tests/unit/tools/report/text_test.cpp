// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <limits>

#include <gtest/gtest.h>

#include "tools/report/svg/indexed_png.hpp"
#include "tools/report/text_format.hpp"

namespace adit {
namespace {

TEST(ReportText, EscapesHtmlCharacters) {
  EXPECT_EQ(escaped("<a href=\"x\">'&'</a>"),
            "&lt;a href=&quot;x&quot;&gt;&#39;&amp;&#39;&lt;/a&gt;");
}

TEST(ReportText, KeepsUtf8AndReplacesInvalidBytes) {
  EXPECT_EQ(escaped("µ – €\U0001F4A1"), "µ – €\U0001F4A1");
  EXPECT_EQ(escaped("a\x01z"), "a\uFFFDz");                  // control character
  EXPECT_EQ(escaped("a\xFFz"), "a\uFFFDz");                  // no lead byte
  EXPECT_EQ(escaped("\xC3"), "\uFFFD");                      // truncated
  EXPECT_EQ(escaped("\xC0\xBC"), "\uFFFD\uFFFD");            // overlong '<'
  EXPECT_EQ(escaped("\xED\xA0\x80"), "\uFFFD\uFFFD\uFFFD");  // half of a surrogate pair
}

TEST(ReportText, FormatsNumbers) {
  EXPECT_EQ(fixed(1.25, 1), "1.2");
  EXPECT_EQ(fixed(-0.01, 1), "0.0");
  EXPECT_EQ(fixed(std::numeric_limits<double>::quiet_NaN(), 1), "–");
  EXPECT_EQ(metres(12.34), "12.3\u00A0m");
  EXPECT_EQ(percent(0.0215), "2.1\u00A0%");
  EXPECT_EQ(percent(0.5), "50\u00A0%");
  EXPECT_EQ(count_text(1, "scan"), "1 scan");
  EXPECT_EQ(count_text(0, "scan"), "0 scans");
}

TEST(ReportText, FormatsTimes) {
  EXPECT_EQ(duration_text(59.4), "59\u00A0s");
  EXPECT_EQ(duration_text(59.6), "1\u00A0min 00\u00A0s");
  EXPECT_EQ(duration_text(7200 + 59 * 60 + 40), "3\u00A0h 00\u00A0min");
  EXPECT_EQ(date_text(1'054'252'800'000'000), "2003-05-30 00:00:00 UTC");
  EXPECT_EQ(clock_text(1'054'252'800'000'000 + 61'500'000), "00:01:01");
}

TEST(ReportText, FormatsSentences) {
  EXPECT_EQ(sentence("no path"), "No path.");
  EXPECT_EQ(sentence("No path!"), "No path!");
  EXPECT_EQ(sentence(""), "");
}

/// RFC 4648, section 10.
TEST(DataUri, EncodesBase64) {
  const auto uri = [](const std::string& text) {
    return data_uri("text/plain",
                    {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  };
  EXPECT_EQ(uri(""), "data:text/plain;base64,");
  EXPECT_EQ(uri("f"), "data:text/plain;base64,Zg==");
  EXPECT_EQ(uri("fo"), "data:text/plain;base64,Zm8=");
  EXPECT_EQ(uri("foo"), "data:text/plain;base64,Zm9v");
  EXPECT_EQ(uri("foobar"), "data:text/plain;base64,Zm9vYmFy");
}

}  // namespace
}  // namespace adit
