#include "netsim/testing/network_test.h"

#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

namespace tandem::netsim {
namespace {

std::optional<std::uint64_t> seed_of_environment() {
  const char* const given = std::getenv("TANDEM_SEED");
  if (given == nullptr) return std::nullopt;
  const std::string_view text = given;
  std::uint64_t seed = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seed);
  if (error != std::errc{} || end != text.data() + text.size())
    throw std::invalid_argument("TANDEM_SEED = " + std::string(text) + ": must be a whole number in [0, 2^64)");
  return seed;
}

}  // namespace

std::string Received::text() const {
  std::string text;
  for (const std::byte b : bytes) text += std::to_integer<char>(b);
  return text;
}

NetworkTest::NetworkTest() : seed_asked_(seed_of_environment()), seed_(seed_asked_.value_or(1)), buffer_(kSlotBytes) {
  restart();
}

NetworkTest::~NetworkTest() {
  if (HasFailure()) std::printf("%s", replay().c_str());
}

std::string NetworkTest::replay() const {
  std::string text = "[  REPLAY  ] network " + description_ + ", seed " + std::to_string(seed_);
  if (const auto* const info = ::testing::UnitTest::GetInstance()->current_test_info(); info != nullptr) {
    text += "; again: TANDEM_SEED=" + std::to_string(seed_) + " " + program_invocation_name +
            " --gtest_filter=" + info->test_suite_name() + "." + info->name();
  }
  text += "\n";
  for (const SceneRun& run : scenes_) text += "[  REPLAY  ] " + replay_command(run) + "\n";
  return text;
}

void NetworkTest::use_profile(std::string_view name) {
  const auto profile = shipped_profile(name);
  if (!profile) throw std::invalid_argument(to_text(profile.error()));
  use_link(profile->link, profile->name + " version " + std::to_string(profile->version));
}

void NetworkTest::use_profile_text(std::string_view text, std::string_view name) {
  const auto profile = parse_profile(text, name);
  if (!profile) throw std::invalid_argument(to_text(profile.error()));
  use_link(profile->link, profile->name);
}

void NetworkTest::use_link(const LinkSpec& link, std::string description) {
  link_ = link;
  description_ = std::move(description);
  restart();
}

void NetworkTest::use_seed(std::uint64_t seed) {
  seed_ = seed_asked_.value_or(seed);
  restart();
}

void NetworkTest::restart() {
  network_ = std::make_unique<Network>(seed_);
  network_->add_link(link_);
  now_ = Time{};
}

bool NetworkTest::advance_to_next() {
  const auto due = network_->next_due();
  if (!due) return false;
  now_ = std::max(now_, *due);
  return true;
}

Outcome NetworkTest::send(Direction direction, std::span<const std::byte> bytes, std::uint32_t link) {
  return network_->send(now_, link, direction, bytes);
}

Outcome NetworkTest::send(Direction direction, std::string_view text, std::uint32_t link) {
  return send(direction, std::as_bytes(std::span{text}), link);
}

std::optional<Received> NetworkTest::receive(Direction direction, std::uint32_t link) {
  const auto got = network_->poll(now_, link, direction, buffer_);
  if (!got) return std::nullopt;
  return Received{
      {buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(got->size)}, got->sent, got->at, got->index};
}

server::RunReport NetworkTest::run_scene(const SceneRun& run) {
  scenes_.push_back(run);
  auto report = netsim::run_scene(run);
  if (!report) throw std::runtime_error(report.error());
  return std::move(*report);
}

}  // namespace tandem::netsim
