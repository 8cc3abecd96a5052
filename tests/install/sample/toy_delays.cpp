// Prints the mean delay and the number of arrivals of a thousand datagrams on a named network.
#include <tandem/netsim.h>

#include <array>
#include <cstdio>

int main(int, char** arguments) {
  using namespace tandem;
  const auto profile =
      arguments[1] == nullptr ? netsim::shipped_profile("ideal") : netsim::shipped_profile(arguments[1]);
  if (!profile) {
    std::fputs(to_text(profile.error()).c_str(), stderr);
    return 2;
  }
  netsim::Network network{1};
  network.add_link(profile->link);
  std::array<std::byte, netsim::kSlotBytes> buffer{};
  for (int i = 0; i < 1000; ++i)
    network.send(Time{std::chrono::milliseconds(i)}, 0, netsim::Direction::kUp, std::span{buffer}.first(100));
  double sum_ms = 0;
  int arrived = 0;
  while (const auto got = network.poll_any(Time{std::chrono::seconds(100)}, buffer)) {
    sum_ms += 1e3 * seconds(got->at - got->sent);
    ++arrived;
  }
  std::printf("%s: %d of 1000 arrived, %.2f ms\n", profile->name.c_str(), arrived, sum_ms / arrived);
  return arrived > 900 ? 0 : 1;
}
