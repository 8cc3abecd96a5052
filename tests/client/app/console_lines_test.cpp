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

TEST_F(ConsoleLinesTest, TakeWhatHasArrivedAndNoMore) {
  EXPECT_TRUE(lines_->take_arrived().empty());
  type("status\nstop danger\nres");
  EXPECT_EQ(lines_->take_arrived(), (std::vector<std::string>{"status", "stop danger"}));
  EXPECT_TRUE(lines_->take_arrived().empty());
  type("ume\n");
  EXPECT_EQ(lines_->next(), "resume") << "its end was typed later";
}

TEST_F(ConsoleLinesTest, TakeAlsoLinesThatWereReadWithAnEarlierOne) {
  type("status\nstop\n");
  EXPECT_EQ(lines_->next(), "status");
  type("resume\n");
  EXPECT_EQ(lines_->take_arrived(), (std::vector<std::string>{"stop", "resume"}));
}

TEST_F(ConsoleLinesTest, TakeNothingAtTheEndOfTheInput) {
  type("stop\nlast");
  typed_ = io::Fd{};
  EXPECT_EQ(lines_->take_arrived(), std::vector<std::string>{"stop"});
  EXPECT_TRUE(lines_->take_arrived().empty());
  EXPECT_EQ(lines_->next(), "last");
  EXPECT_EQ(lines_->next(), std::nullopt);
  EXPECT_FALSE(lines_->server_gone());
}

}  // namespace
}  // namespace tandem::client
