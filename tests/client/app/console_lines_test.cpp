// Lines that are typed at a console, also while it has no connection.
#include "client/app/console_lines.h"

#include <fcntl.h>
#include <gtest/gtest.h>

#include <string>

#include "common/io/event_fd.h"
#include "common/io/fd.h"

namespace tandem::client {
namespace {

class ConsoleLinesTest : public ::testing::Test {
 protected:
  ConsoleLinesTest() {
    int ends[2];
    EXPECT_EQ(::pipe2(ends, O_NONBLOCK), 0);
    input_ = io::Fd{ends[0]};
    typed_ = io::Fd{ends[1]};
    lines_.emplace(signals_.get(), server_.get(), input_.get());
  }
  void type(const std::string& text) {
    ASSERT_EQ(::write(typed_.get(), text.data(), text.size()), static_cast<ssize_t>(text.size()));
  }

  io::EventFd signals_, server_;
  io::Fd input_, typed_;
  std::optional<ConsoleLines> lines_;
};

/// The begin of a line belongs to the time without a connection: with the end of a later one it is another order.
TEST_F(ConsoleLinesTest, TakeWhatHasArrivedAndDropTheBeginOfALineWithItsEnd) {
  EXPECT_TRUE(lines_->take_arrived().lines.empty());
  type("status\nstop danger\nstop ");
  const auto arrived = lines_->take_arrived();
  EXPECT_EQ(arrived.lines, (std::vector<std::string>{"status", "stop danger"}));
  EXPECT_EQ(arrived.begun, "stop ");
  EXPECT_TRUE(lines_->take_arrived().lines.empty());
  type("sta");
  EXPECT_EQ(lines_->take_arrived().begun, "sta") << "still the same line";
  type("tus\nsessions\n");
  EXPECT_EQ(lines_->next(), "sessions");
}

TEST_F(ConsoleLinesTest, TakeAlsoLinesThatWereReadWithAnEarlierOne) {
  type("status\nstop\n");
  EXPECT_EQ(lines_->next(), "status");
  type("resume\n");
  EXPECT_EQ(lines_->take_arrived().lines, (std::vector<std::string>{"stop", "resume"}));
}

TEST_F(ConsoleLinesTest, TakeNothingAtTheEndOfTheInput) {
  type("stop\nlast");
  typed_ = io::Fd{};
  const auto arrived = lines_->take_arrived();
  EXPECT_EQ(arrived.lines, std::vector<std::string>{"stop"});
  EXPECT_EQ(arrived.begun, "last");
  EXPECT_TRUE(lines_->take_arrived().lines.empty());
  EXPECT_EQ(lines_->next(), std::nullopt);
  EXPECT_FALSE(lines_->server_gone());
}

TEST(TypedLines, AreEditedAndKeptUntilEnter) {
  TypedLine line;
  const auto type = [&line](std::string_view keys) {
    std::string shown;
    for (const char c : keys) shown += line.on_key(std::string(1, c));
    return shown;
  };
  EXPECT_EQ(type("stop no"), "stop no");
  EXPECT_TRUE(line.on_key("left").empty());
  EXPECT_EQ(line.text(), "stop no");
  type("\x7f");
  EXPECT_TRUE(line.redraw());
  EXPECT_EQ(line.text(), "stop n");
  type("\x17");
  EXPECT_EQ(line.text(), "stop ");
  type("\xc3\xa9\x7f");
  EXPECT_EQ(line.text(), "stop ") << "a character of two bytes is removed whole";
  type("\x15status\x04");
  EXPECT_FALSE(line.ended()) << "only an empty line ends the input";
  EXPECT_EQ(type("\n"), "\n");
  EXPECT_EQ(line.take_finished(), "status\n");
  EXPECT_TRUE(line.text().empty() && line.take_finished().empty());
  type("\x7f\x15\x17");
  EXPECT_FALSE(line.redraw());
  type("\x04");
  EXPECT_TRUE(line.ended());
}

}  // namespace
}  // namespace tandem::client
