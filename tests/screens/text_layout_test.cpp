// Lines for terminals of any width: never cut inside a word.
#include "common/io/text_layout.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "common/base/rng.h"
#include "common/io/help_text.h"

namespace tandem::io {
namespace {

std::set<std::string> words_of(const std::string& text) {
  std::set<std::string> words;
  std::string word;
  for (const char c : text + " ") {
    if (c != ' ' && c != '\n') {
      word += c;
    } else if (!word.empty()) {
      words.insert(std::exchange(word, ""));
    }
  }
  return words;
}

TEST(TextLayout, BreaksOnlyBetweenWordsAndLosesNone) {
  RandomStream random{1};
  for (int round = 0; round < 200; ++round) {
    std::string text;
    for (std::uint64_t n = 1 + random.below(40); n > 0; --n)
      text += (text.empty() ? "" : " ") + std::string(1 + random.below(18), static_cast<char>('a' + random.below(26)));
    const std::size_t width = 28 + random.below(180), indent = random.below(8);
    std::string all;
    for (const std::string& line : wrap_words(text, width, indent)) {
      EXPECT_LE(line.size(), width);
      all += line + " ";
    }
    EXPECT_EQ(words_of(all), words_of(text)) << width;
  }
}

TEST(TextLayout, CountsCharactersNotBytes) {
  EXPECT_EQ(display_width("✓ ä"), 3u);
  EXPECT_EQ(wrap_words("ää öö", 5).size(), 1u);
}

TEST(TextLayout, KeepsAWordThatIsWiderThanTheTerminalWhole) {
  const auto lines = wrap_words("see https://example.org/a/very/long/address now", 20);
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[1], "https://example.org/a/very/long/address");
}

TEST(TextLayout, OmitsTheLeastImportantFirst) {
  const std::vector<ScreenItem> items{{"state of it all", "state", 0},
                                      {"no leader", "", 0},
                                      {"force 1.2 N", "", 0},
                                      {"tool near", "", 1},
                                      {"rtt 1 ms", "", 1}};
  EXPECT_EQ(lay_out_items(items, 2, 80),
            (std::vector<std::string>{"state of it all | no leader | force 1.2 N", "tool near | rtt 1 ms"}));
  // Items that do not fit in the upper row precede the items of the lower row.
  EXPECT_EQ(lay_out_items(items, 2, 30),
            (std::vector<std::string>{"state of it all | no leader", "force 1.2 N | tool near"}));
  EXPECT_EQ(lay_out_items(items, 1, 30), (std::vector<std::string>{"state of it all | no leader"}));
  EXPECT_EQ(lay_out_items(items, 2, 14).front(), "state") << "the shorter form before anything is cut";
  EXPECT_EQ(join_items(items), "state of it all | no leader | force 1.2 N | tool near | rtt 1 ms");
}

TEST(TextLayout, CutsTheFirstItemAfterAWordWhenNothingElseHelps) {
  const std::vector<ScreenItem> items{{"STOPPED by operator with a long name", "", 0}};
  EXPECT_EQ(lay_out_items(items, 2, 24), (std::vector<std::string>{"STOPPED by operator ..."}));
  for (std::size_t width = 4; width < 60; ++width)
    for (const std::string& line : lay_out_items(items, 2, width)) EXPECT_LE(display_width(line), width);
}

constexpr const char* kHelp =
    "Judges the network for as long as it is\n"
    "asked to, and says so.\n"
    "Exit: 0 done, 1 trouble.\n\n"
    "Devices\n"
    "  sim                  simulated, as the scene describes the device of the seat\n"
    "                       and its hand\n"
    "  sim:hand=NAME        another hand\n\n"
    "Examples\n"
    "  tandem-client join --server 127.0.0.1:7000 --seat trainer --device sim:motion=baton.csv\n"
    "      --alpha-script handover.csv\n";

TEST(HelpFormatter, FillsParagraphsAndKeepsTables) {
  const std::string wide = fill_paragraphs(kHelp, 119);
  EXPECT_NE(
      wide.find(
          "Judges the network for as long as it is asked to, and says so.\nExit: 0 done, 1 trouble.\n\nDevices\n"),
      std::string::npos)
      << wide;
  EXPECT_NE(wide.find("  sim                  simulated, as the scene describes the device of the seat and its hand\n"),
            std::string::npos)
      << wide;
  EXPECT_NE(wide.find("  tandem-client join --server 127.0.0.1:7000 --seat trainer --device sim:motion=baton.csv "
                      "--alpha-script handover.csv\n"),
            std::string::npos)
      << wide;
}

TEST(HelpFormatter, ContinuesARowWhoseFirstColumnIsLongAtTheColumnOfTheOthers) {
  constexpr const char* kRows =
      "Commands\n"
      "  end SESSION         closes it\n"
      "  create NAME SCENE [tickets] [time=S]  opens a session; prints\n"
      "                      its code, and a ticket\n"
      "  sessions            lists them\n";
  EXPECT_EQ(fill_paragraphs(kRows, 70),
            "Commands\n"
            "  end SESSION         closes it\n"
            "  create NAME SCENE [tickets] [time=S]\n"
            "      opens a session; prints its code, and a ticket\n"
            "  sessions            lists them\n");
}

TEST(HelpFormatter, FitsEveryWidthWithoutCuttingAWord) {
  for (const std::size_t width : {40u, 60u, 79u, 99u, 119u, 199u}) {
    const std::string text = fill_paragraphs(kHelp, width);
    std::size_t at = 0;
    while (at < text.size()) {
      const std::size_t end = text.find('\n', at);
      EXPECT_LE(end - at, width) << text.substr(at, end - at);
      at = end + 1;
    }
    std::set<std::string> got = words_of(text);
    got.erase("\\");
    EXPECT_EQ(got, words_of(kHelp)) << text;
  }
}

TEST(HelpFormatter, ContinuesCommandsSoThatTheyCanBeCopied) {
  const std::string text = fill_paragraphs(kHelp, 60);
  const auto at = text.find("  tandem-client join");
  ASSERT_NE(at, std::string::npos);
  std::string command;
  for (std::size_t i = at; i < text.size(); ++i) {
    if (text.compare(i, 2, "\\\n") == 0) {
      ++i;
      continue;
    }
    command += text[i];
  }
  EXPECT_EQ(words_of(command), words_of("tandem-client join --server 127.0.0.1:7000 --seat trainer --device "
                                        "sim:motion=baton.csv --alpha-script handover.csv"));
  EXPECT_EQ(command.find('\n'), command.size() - 1) << "one line for a shell:\n" << text;
}

}  // namespace
}  // namespace tandem::io
