// Example of another project that tests its own protocol over Tandem's simulated networks, in virtual time.
#include <tandem/testing.h>

#include <cstdlib>
#include <numeric>

using namespace std::chrono_literals;
using tandem::netsim::Direction;

/// Sender of the protocol under test: sends numbers in order and repeats each until it is acknowledged.
class Sender {
 public:
  explicit Sender(int count) : count_(count) {}
  std::optional<std::string> poll(tandem::Time now) {
    if (done() || now < again_at_) return std::nullopt;
    again_at_ = now + std::chrono::milliseconds(100);
    return std::to_string(next_);
  }
  void on_acknowledgement(const std::string& number) {
    if (std::atoi(number.c_str()) != next_) return;
    ++next_;
    again_at_ = {};
  }
  [[nodiscard]] bool done() const { return next_ == count_; }

 private:
  int count_, next_ = 0;
  tandem::Time again_at_{};
};

class Receiver {
 public:
  /// @return the number to acknowledge
  std::string on_number(const std::string& number) {
    if (numbers_.empty() || numbers_.back() != std::atoi(number.c_str())) numbers_.push_back(std::atoi(number.c_str()));
    return number;
  }
  [[nodiscard]] const std::vector<int>& numbers() const { return numbers_; }

 private:
  std::vector<int> numbers_;
};

struct Toy : tandem::netsim::NetworkTest {};

TEST_F(Toy, DeliversEveryNumberOnceThroughABadNetwork) {
  for_seeds(20, [&] {
    use_profile("wifi-busy");
    Sender sender{50};
    Receiver receiver;
    run_for(30s, 1ms, [&] {
      if (const auto number = sender.poll(now())) send(Direction::kUp, *number);
      while (const auto got = receive(Direction::kUp)) send(Direction::kDown, receiver.on_number(got->text()));
      while (const auto got = receive(Direction::kDown)) sender.on_acknowledgement(got->text());
    });
    std::vector<int> all(50);
    std::iota(all.begin(), all.end(), 0);
    EXPECT_EQ(receiver.numbers(), all);
  });
}

TEST_F(Toy, WaitsAtLeastARoundTripForEachNumber) {
  use_numbers({.delay = 40ms});
  Sender sender{5};
  Receiver receiver;
  while (!sender.done()) {
    if (const auto number = sender.poll(now())) send(Direction::kUp, *number);
    ASSERT_TRUE(advance_to_next());
    while (const auto got = receive(Direction::kUp)) send(Direction::kDown, receiver.on_number(got->text()));
    while (const auto got = receive(Direction::kDown)) sender.on_acknowledgement(got->text());
  }
  EXPECT_EQ(now(), tandem::Time{5 * 80ms});
}

TEST_F(Toy, ASessionStaysPassiveOverTheSameNetwork) {
  const auto report = run_scene({.scene = "free_motion", .profile = "wifi-busy", .seed = 7, .duration_s = 5});
  EXPECT_TRUE(report.passed);
  EXPECT_LT(report.seats[0].metrics.effort_peak_n, 10);
}

// Shows the output of a failing test. It fails only if TOY_FAILS is set: it then expects a network without loss to drop
// a datagram.
TEST_F(Toy, FailsWhenAskedTo) {
  use_seed(3);
  use_profile("ideal");
  send(Direction::kUp, "x");
  EXPECT_EQ(counters(Direction::kUp).dropped(), std::getenv("TOY_FAILS") == nullptr ? 0U : 1U);
}
